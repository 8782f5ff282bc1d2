#include "sample/implicit/cube_descent.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>

#include "sample/implicit/cube_box.h"

namespace pdc::detail {

Coord blockCounts(const Coord& cells) {
  Coord n;
  for (int axis = 0; axis < 3; ++axis) n[axis] = (cells[axis] + kBlockSize - 1) / kBlockSize;
  return n;
}

Box searchBox(const BlockSearch& search, const Coord& cube, int level) {
  constexpr double kMargin = 1e-6;  // voxels
  return cubeBox(search.frame, cube, level, kMargin);
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
    drop[i] = oneSided(search.fields.in(cubes[i], level)->bound(searchBox(search, cubes[i], level)));
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
