#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pdc/monitor.h"
#include "simplify/decimation/decimated_surface.h"
#include "simplify/decimation/edge_collapse.h"
#include "simplify/vertex_stars.h"

namespace pdc::detail {

/// Pairs of faces that intersect, decided exactly on positions as the result will have them: in single precision, in
/// world space. \throws Cancelled.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> intersectingFaces(const LocalFrame& frame,
                                                                          std::span<const Vec3d> positions,
                                                                          std::span<const Triangle> faces,
                                                                          const Monitor& monitor);

/// Splits collapses, which do not touch each other, into such as make no face intersect another and the rest, which is
/// returned. What intersects before does not count, unless a face of it changes.
[[nodiscard]] std::vector<ChosenCollapse> takeOutIntersecting(const DecimatedSurface& surface, const VertexStars& stars,
                                                              std::vector<ChosenCollapse>& collapses,
                                                              const Monitor& monitor);

}  // namespace pdc::detail
