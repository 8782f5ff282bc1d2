#pragma once

#include "pdc/sample/hermite_block.h"
#include "pdc/sample/lattice_map.h"

namespace pdc::detail {

/// How far, in lattice units along an axis, rounding the world coordinates of a point in or near a block to single
/// precision may move it.
[[nodiscard]] double cellRounding(const LatticeMap& map, const Coord& block);

}  // namespace pdc::detail
