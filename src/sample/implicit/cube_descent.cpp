#include "sample/implicit/cube_descent.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pdc::detail {

Coord blockCounts(const BlockSearch& search) {
  Coord n;
  for (int axis = 0; axis < 3; ++axis) n[axis] = (search.cells[axis] + kBlockSize - 1) / kBlockSize;
  return n;
}

Interval boundOf(const BlockSearch& search, const Coord& cube, int level) {
  constexpr double kRelativeMargin = 1e-6;
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  const double size = std::ldexp(kBlockSize, level);
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double first = cube[axis] * size;
    const double lo = search.frame.at(axis, first), hi = search.frame.at(axis, first + size);
    const double margin = kRelativeMargin * search.frame.voxelSize + kRounding * std::max(std::abs(lo), std::abs(hi));
    box.lo[axis] = lo - margin;
    box.hi[axis] = hi + margin;
  }
  return search.field.bound(box);
}

std::vector<Coord> children(const std::vector<Coord>& cubes, int level, const Coord& blocks) {
  std::vector<Coord> result;
  result.reserve(8 * cubes.size());
  for (const Coord& cube : cubes)
    for (int corner = 0; corner < 8; ++corner) {
      const Coord child{2 * cube[0] + (corner >> 2), 2 * cube[1] + (corner >> 1 & 1), 2 * cube[2] + (corner & 1)};
      bool within = true;
      for (int axis = 0; axis < 3; ++axis) within = within && child[axis] << level < blocks[axis];
      if (within) result.push_back(child);
    }
  return result;
}

void dropOneSided(const BlockSearch& search, int level, const Monitor& monitor, std::vector<Coord>& cubes) {
  std::vector<std::uint8_t> drop(cubes.size());
  tbb::parallel_for(std::size_t{0}, cubes.size(), [&](std::size_t i) {
    monitor.throwIfStopped();
    drop[i] = oneSided(boundOf(search, cubes[i], level));
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cubes.size(); ++i)
    if (drop[i] == 0) cubes[kept++] = cubes[i];
  cubes.resize(kept);
}

int topLevel(const Coord& blocks) {
  int level = 0;
  while (1 << level < std::max({blocks[0], blocks[1], blocks[2]})) ++level;
  return level;
}

}  // namespace pdc::detail
