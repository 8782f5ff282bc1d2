#pragma once

#include <array>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

using TriangleCorners = std::array<Vec3f, 3>;

/// Whether the corners lie on one line, decided exactly.
[[nodiscard]] bool isDegenerate(const TriangleCorners& t);

/// On which side of the other's plane each corner of two triangles is, as orient3d says it; 0 where that is not known.
struct TriangleSides {
  using Signs = std::array<int, 3>;
  Signs a{}, b{};
};

/// Whether two triangles of a mesh meet elsewhere than they should: in more than the vertex or the edge they share.
///
/// - Two or three shared vertices: if they are coplanar and on the same side of a shared edge.
/// - One: if the opposite edge of either meets the other triangle.
/// - None: if they have a point in common.
///
/// Triangles and edges include their borders, so a touch counts. Decided exactly for all finite coordinates; the order
/// of the two triangles and of their corners does not matter. `aVertices` and `bVertices` are only compared with each
/// other. For degenerate triangles the answer means nothing.
///
/// The semantics are those of self_intersections in CGAL's Polygon Mesh Processing.
///
/// \param known what the caller knows of the sides already; it only saves time.
[[nodiscard]] bool trianglesIntersect(const TriangleCorners& a, const Triangle& aVertices, const TriangleCorners& b,
                                      const Triangle& bVertices, const TriangleSides& known = {});

}  // namespace pdc::detail
