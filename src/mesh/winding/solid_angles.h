#pragma once

#include <array>
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
  [[nodiscard]] double at(const Vec3d& p) const;
  /// How it changes per unit of length. Where p is in a triangle the jump there does not count.
  [[nodiscard]] Vec3d gradient(const Vec3d& p) const;
  /// A number that |at()| does not exceed in a box, if that is below `limit`; else any that is not below it.
  [[nodiscard]] double bound(const Box& box, double limit) const;

 private:
  static constexpr std::uint32_t kLeaf = 8;

  struct Node {
    std::uint32_t first, count;  ///< Of mTriangles.
    std::uint32_t child = 0;     ///< The first of two; 0 for a leaf.
    std::uint32_t leaf = 0;      ///< Of mLeaves.
    double radius = 0;           ///< About the middle.
    double area = 0;
    Vec3d middle{}, normal{};  ///< normal: the sum of the area vectors.
    /// The sum of the products of places, from the middle, and area vectors.
    Mat3d moment = Mat3d::diagonal(0, 0, 0);
  };

  /// Corners of a leaf's triangles, by corner and axis. A triangle of one point fills the rest; it adds nothing.
  struct Leaf {
    std::array<std::array<std::array<double, kLeaf>, 3>, 3> corner;
  };
  class Turns;

  void build(std::uint32_t node);
  void summarise(Node& node) const;
  void fillLeaf(Node& node);
  /// Calls far(node) for nodes whose triangles count together at p, and near(node) for leaves where they do not.
  template <typename Far, typename Near>
  void visit(const Vec3d& p, const Far& far, const Near& near) const;
  void addTurns(const Node& node, const Vec3d& p, Turns& turns) const;
  /// What a node's triangles add at a place from which they count together.
  [[nodiscard]] static double farAngle(const Node& node, const Vec3d& p);
  void addBound(std::uint32_t node, const Box& box, double limit, double& sum) const;

  const ClosedSurface& mSurface;
  std::vector<std::uint32_t> mTriangles;
  std::vector<Node> mNodes;
  std::vector<Leaf> mLeaves;
};

}  // namespace pdc::detail
