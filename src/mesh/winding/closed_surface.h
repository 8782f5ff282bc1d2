#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc::detail {

/// Triangles of a mesh and, behind them, caps that close it: from each edge whose triangles do not cancel there to a
/// point amid the loop of such edges that it belongs to. Then every line enters as often as it leaves, so that the
/// winding number of all is a whole number everywhere but on them, and that of the mesh itself is this number less the
/// caps' own.
struct ClosedSurface {
  Mesh surface;         ///< Has triangles only; all have finite corners and name three vertices.
  std::size_t own = 0;  ///< The first triangles, those of the mesh; the others are caps.

  [[nodiscard]] std::array<Vec3d, 3> points(std::size_t triangle) const {
    const Triangle& t = surface.triangles[triangle];
    return {vecCast<double>(surface.positions[t[0]]), vecCast<double>(surface.positions[t[1]]),
            vecCast<double>(surface.positions[t[2]])};
  }
  /// The numbers of the caps.
  [[nodiscard]] std::vector<std::uint32_t> caps() const;
};

/// Vertices nearer to each other than 2^-22 of the longest side of their box become one, so that cracks of rounding
/// need no caps. Triangles with a corner that is not finite are left out. \throws as Mesh says; Error for more than
/// 2^32 - 1 triangles; Cancelled.
[[nodiscard]] ClosedSurface closeSurface(const Mesh& mesh, const Monitor& monitor = {});

}  // namespace pdc::detail
