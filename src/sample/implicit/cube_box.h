#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "pdc/math/box.h"
#include "pdc/sample/lattice.h"
#include "sample/implicit/lattice_frame.h"

namespace pdc::detail {

/// The box of a cube of 2^level blocks along an axis, grown by `margin` voxels and by what rounds lattice points.
inline Box cubeBox(const LatticeFrame& frame, const Coord& cube, int level, double margin) {
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  const double size = std::ldexp(kBlockSize, level);
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double first = cube[axis] * size;
    const double lo = frame.at(axis, first), hi = frame.at(axis, first + size);
    const double room = margin * frame.voxelSize + kRounding * std::max(std::abs(lo), std::abs(hi));
    box.lo[axis] = lo - room;
    box.hi[axis] = hi + room;
  }
  return box;
}

}  // namespace pdc::detail
