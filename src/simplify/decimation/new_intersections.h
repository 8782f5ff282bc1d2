#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pdc/monitor.h"
#include "simplify/decimated_surface.h"
#include "simplify/edge_collapse.h"
#include "simplify/vertex_stars.h"

namespace pdc::detail {

using FacePairs = std::vector<std::array<std::uint32_t, 2>>;

/// Pairs of faces that intersect, decided exactly on positions of the surface's vertices as the result will have them:
/// in single precision, in world space. \throws Cancelled.
[[nodiscard]] FacePairs intersectingFaces(const DecimatedSurface& surface, std::span<const Vec3d> positions,
                                          std::span<const Triangle> faces, const Monitor& monitor);

/// Splits collapses, which do not touch each other, into such as make no faces intersect that did not before, nor did
/// those they came from, and the rest, which is returned.
/// \param pairs of the surface's faces that intersect; replaced by those after the collapses that stay, whose faces
/// have the order that they had. \throws Cancelled.
[[nodiscard]] std::vector<ChosenCollapse> takeOutIntersecting(const DecimatedSurface& surface, const VertexStars& stars,
                                                              std::vector<ChosenCollapse>& collapses, FacePairs& pairs,
                                                              const Monitor& monitor);

}  // namespace pdc::detail
