#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pdc/monitor.h"
#include "simplify/decimated_surface.h"

namespace pdc::detail {

using FacePairs = std::vector<std::array<std::uint32_t, 2>>;

/// Pairs of faces that intersect, the lower first, sorted; decided exactly on positions of the surface's vertices as
/// the result will have them: in single precision, in world space. \throws Cancelled.
[[nodiscard]] FacePairs intersectingFaces(const DecimatedSurface& surface, std::span<const Vec3d> positions,
                                          std::span<const Triangle> faces, const Monitor& monitor);

}  // namespace pdc::detail
