#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/view_mesh.h"

namespace pdc::detail {

/// The triangles of a picture, divided by who finds them: rays, or rows of samples. Boxes fit slivers so badly that a
/// ray through a fan of many looks at most of them; along the rows of a picture each covers next to nothing.
struct DividedTriangles {
  Buffer<std::uint32_t> slivers;  ///< Indices in ViewMesh::triangles.
  Buffer<Triangle> others;
  Buffer<std::uint32_t> otherNumbers;  ///< Indices of `others` in ViewMesh::triangles.
  /// What hides the sky from others: all triangles, but slivers made wider by uniting their ends.
  Buffer<Triangle> occluders;
};

/// Divides them where rays would meet the boxes of more than a few slivers at most places of a picture of this size;
/// else all lists are empty, and rays are to find all triangles.
[[nodiscard]] DividedTriangles divideTriangles(const ViewMesh& mesh, int width, int height);

/// Where a triangle covers a row of samples.
struct Span {
  double begin = 0, end = 0;  ///< x in pixels, begin included; nothing if end <= begin.
};

/// A point on the border of two triangles is in one of them.
[[nodiscard]] Span rowSpan(const std::array<Vec3f, 3>& corners, double y);

/// Barycentric weights of (x, y) in a triangle that is not seen edge-on, made at least 0.
[[nodiscard]] std::array<float, 3> planeWeights(const std::array<Vec3f, 3>& corners, double x, double y);

}  // namespace pdc::detail
