#pragma once

#include "simplify/decimated_surface.h"
#include "simplify/edge_collapse.h"
#include "simplify/vertex_stars.h"

namespace pdc::detail {

/// A bound on how far the faces about an edge go when it is collapsed, in world units, on positions as the result will
/// have them: there is a map one-to-one between the faces before and after under which no point goes farther.
///
/// Both are seen along their common normal, as heights over one region of a plane. The difference is linear where
/// neither bends, so that it is largest at a vertex or where edges cross (Cohen, Manocha & Olano 1997 map surfaces that
/// way). Infinite where they are not heights, or too steep, or at the boundary.
[[nodiscard]] double starGap(const DecimatedSurface& surface, const VertexStars& stars, const ChosenCollapse& collapse);

}  // namespace pdc::detail
