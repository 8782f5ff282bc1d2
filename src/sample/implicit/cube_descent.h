#pragma once

#include <vector>

#include "pdc/monitor.h"
#include "sample/implicit/block_search.h"

/// The descent from one box over the lattice to its blocks, by cubes of 2^level blocks along an axis.
namespace pdc::detail {

/// Blocks along each axis of a lattice of so many cells.
[[nodiscard]] Coord blockCounts(const Coord& cells);

/// The level of the one cube that holds all blocks.
[[nodiscard]] int topLevel(const Coord& blocks);

/// The box of a cube, grown a little, so that neither the rounding of lattice points nor that of bound() itself can
/// hide a surface that touches it.
[[nodiscard]] Box searchBox(const BlockSearch& search, const Coord& cube, int level);

/// Whether a bound excludes a surface; a zero may be on either side.
[[nodiscard]] inline bool oneSided(const Interval& bound) { return bound.lo > 0 || bound.hi < 0; }

/// The cubes of the next finer `level` that reach into the lattice.
[[nodiscard]] std::vector<Coord> children(const std::vector<Coord>& cubes, int level, const Coord& blocks);

/// Keeps the cubes whose bounds do not exclude a surface. Runs in parallel. \throws Cancelled
void dropOneSided(const BlockSearch& search, int level, const Monitor& monitor, std::vector<Coord>& cubes);

}  // namespace pdc::detail
