#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/winding/closed_surface.h"
#include "pdc/math/box.h"
#include "pdc/math/mat3.h"

namespace pdc::detail {

/// The sum of the signed solid angles under which triangles are seen from a point, in whole spheres: the winding number
/// that they add there. Triangles far away count together, by the first two terms of their expansion about the middle
/// of their areas: Barill, Dickson, Schmidt, Levin & Jacobson 2018, Fast Winding Numbers for Soups and Clouds. Several
/// threads may ask at a time; the sums do not depend on them.
class SolidAngles {
 public:
  /// \param triangles of the surface, which has to live as long. Runs on the calling thread.
  SolidAngles(const ClosedSurface& surface, std::vector<std::uint32_t> triangles);

  [[nodiscard]] bool empty() const { return mNodes.empty(); }
  /// Positive where the triangles are clockwise, seen from p, as those of a closed surface are from inside. Beside a
  /// triangle the sign is exact, as sideOfPlane() decides it.
  [[nodiscard]] double at(const Vec3d& p) const { return mNodes.empty() ? 0 : below(0, p); }
  /// How it changes per unit of length, by differences over `step`. Where p is beside a triangle the jump there does
  /// not count.
  [[nodiscard]] Vec3d gradient(const Vec3d& p, double step) const;
  /// A number that |at()| does not exceed in a box, if that is below `limit`; else any that is not below it.
  [[nodiscard]] double bound(const Box& box, double limit) const;

 private:
  struct Node {
    std::uint32_t first, count;  ///< Of mTriangles.
    std::uint32_t child = 0;     ///< The first of two; 0 for a leaf.
    double radius = 0;           ///< About the middle.
    double area = 0;
    Vec3d middle{}, normal{};  ///< normal: the sum of the area vectors.
    /// The sum of the products of places, from the middle, and area vectors.
    Mat3d moment = Mat3d::diagonal(0, 0, 0);
  };

  void build(std::uint32_t node);
  void summarise(Node& node) const;
  [[nodiscard]] double below(std::uint32_t node, const Vec3d& p) const;
  void addBound(std::uint32_t node, const Box& box, double limit, double& sum) const;

  const ClosedSurface& mSurface;
  std::vector<std::uint32_t> mTriangles;
  std::vector<Node> mNodes;
};

}  // namespace pdc::detail
