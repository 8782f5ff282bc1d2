#pragma once

#include "pdc/sample/hermite_block.h"
#include "pdc/sample/lattice_map.h"

namespace pdc::detail {

/// How far, in lattice units along an axis, rounding the world coordinates of a point in or near a block to single
/// precision, or to the map's step, may move it.
[[nodiscard]] double cellRounding(const LatticeMap& map, const Coord& block);

/// Half the size of the part of a block's cells whose points stay well within the cell when they are rounded so.
[[nodiscard]] double roundedCellHalfSize(const LatticeMap& map, const Coord& block);

/// A vertex no farther than this, in lattice units, beyond that part of its cell is put back into it: surfaces that lie
/// on lattice planes have all their vertices there, give or take rounding.
inline constexpr double kSnap = 1e-4;

}  // namespace pdc::detail
