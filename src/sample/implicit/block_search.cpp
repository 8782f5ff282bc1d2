#include "sample/implicit/block_search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_set>
#include <utility>
#include <vector>

#include "sample/implicit/block_signs.h"
#include "sample/implicit/cube_descent.h"

namespace pdc::detail {
namespace {

// Blocks sampled between two progress reports; bounds the memory for signs that are thrown away.
constexpr std::size_t kChunk = 4096;

/// Runs body(i) for i in [0, size) in parallel; stops within one of them.
template <typename Body>
void forEach(std::size_t size, const Monitor& monitor, Body&& body) {
  tbb::parallel_for(std::size_t{0}, size, [&](std::size_t i) {
    monitor.throwIfStopped();
    body(i);
  });
}

/// All blocks whose parents the field's bounds do not exclude, sorted.
std::vector<Coord> candidates(const BlockSearch& search, const Monitor& monitor) {
  const Coord blocks = blockCounts(search.cells);
  int level = topLevel(blocks);
  std::vector<Coord> cubes{Coord{0, 0, 0}};
  while (level > 0) {
    dropOneSided(search, level, monitor, cubes);
    cubes = children(cubes, --level, blocks);
  }
  std::sort(cubes.begin(), cubes.end());
  return cubes;
}

bool sampleBlock(const BlockSearch& search, const Field& field, const Coord& block, BlockSigns& signs) {
  sampleSigns(field, search.frame, block, signs, search.missing);
  signs.cells = search.open ? cellsWithin(block, search.cells) : CellMask::all();
  return !signs.uniform() && !signs.cells.none();
}

bool searchBlock(const BlockSearch& search, const Coord& block, BlockSigns& signs) {
  const LocalField field = search.fields.in(block, 0);
  const Interval bound = field->bound(searchBox(search, block, 0));
  if (oneSided(bound)) return false;
  if (!bound.bounded() && !coarseSignsDiffer(*field, search.frame, block, search.missing)) return false;
  return sampleBlock(search, *field, block, signs);
}

/// Appends those of `blocks` for which test(block, signs) finds surface, in order.
template <typename Test, typename Progress>
void appendSurface(const BlockSearch& search, const std::vector<Coord>& blocks, const Monitor& monitor,
                   SurfaceBlocks& surface, Test&& test, Progress&& progress) {
  std::vector<BlockSigns> signs(std::min(kChunk, blocks.size()));
  std::vector<std::uint8_t> keep(signs.size());
  for (std::size_t first = 0; first < blocks.size(); first += kChunk) {
    const std::size_t size = std::min(kChunk, blocks.size() - first);
    forEach(size, monitor, [&](std::size_t i) { keep[i] = test(blocks[first + i], signs[i]); });
    if (search.missing != nullptr) search.missing->throwIfMany();
    for (std::size_t i = 0; i < size; ++i) {
      if (keep[i] == 0) continue;
      surface.coords.push_back(blocks[first + i]);
      surface.signs.push_back(signs[i]);
    }
    progress(static_cast<double>(first + size) / static_cast<double>(blocks.size()));
  }
}

std::uint64_t key(const Coord& block) {
  constexpr int kBits = 21;
  return (static_cast<std::uint64_t>(block[0]) << kBits | static_cast<std::uint64_t>(block[1])) << kBits |
         static_cast<std::uint64_t>(block[2]);
}

Coord neighbour(const Coord& block, int face) {
  Coord n = block;
  n[face / 2] += face % 2 == 0 ? -1 : 1;
  return n;
}

/// The blocks of the lattice that surface runs into from surface.coords[first...) and that known(block) does not hold.
template <typename Known>
std::vector<Coord> missingNeighbours(const BlockSearch& search, const SurfaceBlocks& surface, std::size_t first,
                                     const Monitor& monitor, Known&& known) {
  const Coord blocks = blockCounts(search.cells);
  const auto within = [&](const Coord& c) {
    for (int axis = 0; axis < 3; ++axis)
      if (c[axis] < 0 || c[axis] >= blocks[axis]) return false;
    return true;
  };
  std::vector<std::uint8_t> faces(surface.coords.size() - first);
  forEach(faces.size(), monitor, [&](std::size_t i) {
    for (int face = 0; face < 6; ++face) {
      const Coord n = neighbour(surface.coords[first + i], face);
      const bool missing = within(n) && faceSignsDiffer(surface.signs[first + i], face / 2, face % 2 != 0) && !known(n);
      faces[i] = static_cast<std::uint8_t>(faces[i] | unsigned{missing} << face);
    }
  });
  std::vector<Coord> missing;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (int face = 0; face < 6; ++face)
      if ((faces[i] >> face & 1) != 0) missing.push_back(neighbour(surface.coords[first + i], face));
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  return missing;
}

/// Follows the surface across block faces until it meets only itself or the lattice's limits.
void grow(const BlockSearch& search, const Monitor& monitor, SurfaceBlocks& surface) {
  const std::vector<Coord> found = surface.coords;
  std::unordered_set<std::uint64_t> grown;
  const auto known = [&](const Coord& block) {
    return std::binary_search(found.begin(), found.end(), block) || grown.contains(key(block));
  };
  for (std::size_t first = 0; first < surface.coords.size();) {
    const std::vector<Coord> missing = missingNeighbours(search, surface, first, monitor, known);
    first = surface.coords.size();
    for (const Coord& block : missing) grown.insert(key(block));
    appendSurface(
        search, missing, monitor, surface,
        [&](const Coord& block, BlockSigns& signs) {
          return sampleBlock(search, *search.fields.in(block, 0), block, signs);
        },
        [](double) {});
  }
}

void sortByCoordinate(SurfaceBlocks& surface) {
  std::vector<std::size_t> order(surface.coords.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return surface.coords[a] < surface.coords[b]; });
  SurfaceBlocks sorted;
  sorted.coords.reserve(order.size());
  sorted.signs.reserve(order.size());
  for (const std::size_t i : order) {
    sorted.coords.push_back(surface.coords[i]);
    sorted.signs.push_back(surface.signs[i]);
  }
  surface = std::move(sorted);
}

}  // namespace

SurfaceBlocks findSurfaceBlocks(const BlockSearch& search, const Monitor& monitor) {
  const auto report = [&](double share) {
    if (monitor.progress) monitor.progress("sample", share);
  };
  monitor.throwIfStopped();
  SurfaceBlocks surface;
  appendSurface(
      search, candidates(search, monitor), monitor, surface,
      [&](const Coord& block, BlockSigns& signs) { return searchBlock(search, block, signs); }, report);
  const std::size_t found = surface.coords.size();
  grow(search, monitor, surface);
  if (search.missing != nullptr) search.missing->throwIfAny();
  if (surface.coords.size() > found) sortByCoordinate(surface);
  surface.open = search.open;
  return surface;
}

}  // namespace pdc::detail
