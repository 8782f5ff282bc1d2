#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/triangle_pair.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

// The boxes of triangles at one vertex all meet, so they tell nothing where many triangles meet at a vertex, a hub.
// There a stand-in for each triangle, another triangle, tells whether it may intersect another one of that hub.

/// What rounding moves stand-ins by, at most.
inline constexpr float kStandInMargin = 1e-6F;

/// For the triangle (hub, a, b): a triangle around the arc in which the directions from the hub to the points of a b
/// cut the unit sphere.
///
/// If two triangles meet at a point besides the hub that they share, then both hold the direction to it, and their arcs
/// meet. \returns nothing for an angle of nearly 180 degrees at the hub.
[[nodiscard]] std::optional<TriangleCorners> arcStandIn(const Vec3f& hub, const Vec3f& a, const Vec3f& b);

/// For the triangle (v, w, p): its unit normal, as a triangle of three equal corners.
///
/// Two triangles that share the edge v w meet elsewhere only if they lie on the same side of it in one plane, which
/// makes their normals equal. \returns nothing where p is so near the line v w that rounding decides on the normal.
[[nodiscard]] std::optional<TriangleCorners> pageStandIn(const Vec3f& v, const Vec3f& w, const Vec3f& p);

/// Triangles and, at the same index, what stands for them: `shapes` has those alone.
struct StandIns {
  Mesh shapes;
  Buffer<std::uint32_t> triangles;

  void add(std::uint32_t triangle, const TriangleCorners& shape);
};

}  // namespace pdc::detail
