#include "extract/topology/continuation.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace pdc::detail {
namespace {

// Bits of the words of a CellMask, which hold a layer of cells with bit 8y + z: its lowest and highest row along y and
// z.
constexpr std::uint64_t kLowY = 0xFF, kLowZ = 0x0101010101010101;

constexpr std::uint64_t toHighY(std::uint64_t w) { return w << 56; }
constexpr std::uint64_t toHighZ(std::uint64_t w) { return w << 7; }
/// What lies one lower along y or z, without what leaves the block there.
constexpr std::uint64_t lowerY(std::uint64_t w) { return w >> 8; }
constexpr std::uint64_t lowerZ(std::uint64_t w) { return (w & ~kLowZ) >> 1; }

/// The cells of the block at -(dx, dy, dz) that a block's quads need, as bits of words.
CellMask neededBelow(const BlockTopology& block, int dx, int dy, int dz) {
  const auto& [ex, ey, ez] = block.edges;
  CellMask needed;
  const int last = kBlockSize - 1;
  if (dx + dy + dz == 1) {
    if (dx != 0) needed.word[last] = ey.word[0] | lowerZ(ey.word[0]) | ez.word[0] | lowerY(ez.word[0]);
    for (int x = 0; x < kBlockSize && dx == 0; ++x) {
      const std::uint64_t low = dy != 0 ? kLowY : kLowZ, along = ex.word[x] & low;
      const std::uint64_t across = (dy != 0 ? ez.word[x] : ey.word[x]) & low;
      const auto moved = [dy](std::uint64_t w) { return dy != 0 ? toHighY(w) : toHighZ(w); };
      needed.word[x] |= moved(along | (dy != 0 ? lowerZ(along) : lowerY(along)) | across);
      if (x > 0) needed.word[x - 1] |= moved(across);
    }
  } else if (dx == 0) {
    for (int x = 0; x < kBlockSize; ++x) needed.word[x] = toHighY(toHighZ(ex.word[x] & kLowY & kLowZ));
  } else {
    needed.word[last] = dy != 0 ? toHighY(ez.word[0] & kLowY) : toHighZ(ey.word[0] & kLowZ);
  }
  return needed;
}

bool hasItsCells(const Topology& topology, std::size_t block) {
  const BlockTopology& own = topology.blocks[block];
  bool all = true;
  for (int i = 1; i < 7; ++i) {
    const CellMask needed = neededBelow(own, i >> 2, i >> 1 & 1, i & 1);
    const std::int32_t lower = own.lower[i];
    for (int x = 0; x < kBlockSize; ++x) {
      const std::uint64_t there = lower == BlockIndex::kMissing ? 0 : topology.blocks[lower].cells.word[x];
      all = all && (needed.word[x] & ~there) == 0;
    }
  }
  return all;
}

}  // namespace

void checkContinuation(const SurfaceBlocks& blocks, const Topology& topology) {
  constexpr std::size_t kGrain = 256, kNoBlock = std::numeric_limits<std::size_t>::max();
  const std::size_t first = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, blocks.coords.size(), kGrain), kNoBlock,
      [&](const tbb::blocked_range<std::size_t>& range, std::size_t found) {
        for (std::size_t i = range.begin(); i != range.end() && found == kNoBlock; ++i)
          if (!hasItsCells(topology, i)) found = i;
        return found;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
  if (first == kNoBlock) return;
  const Coord& c = blocks.coords[first];
  throw std::invalid_argument(fmt::format(
      "contour: the source's blocks are not closed under continuation, or signs of points that blocks share differ: "
      "block ({}, {}, {}) has surface that goes on below it, where there is none",
      c[0], c[1], c[2]));
}

}  // namespace pdc::detail
