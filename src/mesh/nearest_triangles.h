#pragma once

#include <cstdint>
#include <limits>

#include "mesh/triangle_tree.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// A triangle's number (see faces.h) and the square of a point's distance from it.
struct NearestTriangle {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t number = kNone;
  double squared = std::numeric_limits<double>::infinity();
};

/// The triangles of a mesh that have finite corners, to be asked for those nearest to points. Several threads may ask
/// at a time. The mesh has to live as long, unchanged. Points are relative to its origin.
class NearestTriangles {
 public:
  /// Runs in parallel. \pre The mesh has passed checkSizes() and checkIndices().
  explicit NearestTriangles(const Mesh& mesh);

  /// There is nothing to find.
  [[nodiscard]] bool empty() const { return mTree.leafCount() == 0; }

  /// The nearest triangle to a finite point. \param guess a triangle that may be near, or kNone; it only saves time.
  [[nodiscard]] NearestTriangle find(const Vec3d& p, std::uint32_t guess = NearestTriangle::kNone) const;

  /// The nearest triangle to a finite point if the square of its distance is below a bound, which saves most of the
  /// search where it is small.
  [[nodiscard]] NearestTriangle findBelow(double squared, const Vec3d& p, std::uint32_t guess) const;

  /// Among the triangles that are equally near, but for rounding, the one whose normal is nearest to a given one: a
  /// point beyond a ridge is as near to one side as to the other. Triangles without area come last.
  [[nodiscard]] NearestTriangle find(const Vec3d& p, const Vec3d& normal, std::uint32_t guess) const;

 private:
  const Mesh& mMesh;
  TriangleTree mTree;
  double mRounding;  ///< Distances that differ by less are taken as equal.
};

/// A normal of a triangle, as long as twice its area.
[[nodiscard]] Vec3d areaNormal(const TriangleCorners& corners);

}  // namespace pdc::detail
