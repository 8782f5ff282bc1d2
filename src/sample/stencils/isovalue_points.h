#pragma once

#include <array>
#include <cstdint>

#include "pdc/sample/hermite_block.h"
#include "sample/creases/distance_stencil.h"
#include "sample/stencils/gradient_stencil.h"

/// Lattice points whose value is the isovalue. Such a point is outside, unless it lies between two points that are
/// strictly below it, one step away along an axis: solids that touch in a layer of points leave it there, and are one.
/// Its value is then taken to be the mean of the two, as beside faces that are flush.
namespace pdc::detail {

/// A leaf's points that have both neighbours along an axis in a set.
/// \param own the set's points in the leaf. \param around its points in the leaves or tiles beyond each face: below and
/// above along x, then y, then z. Bits as in CellMask.
[[nodiscard]] CellMask pointsBetween(const CellMask& own, const std::array<CellMask, 6>& around);

/// Places the crossings next to such points; between two zeros they come to lie at the outside end. Normals stay.
void placeIsovalueCrossings(const GradientStencil& stencil, const BlockSigns& signs, const EdgeIndex& edges,
                            HermiteBlock& hermite);

/// Gives such points their value, in the rows that were read. Those at the stencil's border stay.
void fillIsovaluePoints(DistanceStencil& stencil);

}  // namespace pdc::detail
