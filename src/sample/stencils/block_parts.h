#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "pdc/sample/hermite_source.h"

/// A block's 9×9×9 points lie in eight places, of a tree each a leaf or a tile: part 4dx + 2dy + dz is the place at
/// block + (dx, dy, dz). The masks below hold a place's 8×8×8 points, bits as in CellMask.
namespace pdc::detail {

inline constexpr int kBlockParts = 8;

/// Where the points of a block lie.
enum class Side : std::uint8_t { kOutside, kInside, kBoth };

/// Where a place's own points lie.
inline Side sideOf(const CellMask& inside) {
  std::uint64_t any = 0, all = ~std::uint64_t{0};
  for (const std::uint64_t w : inside.word) {
    any |= w;
    all &= w;
  }
  return any == 0 ? Side::kOutside : ~all == 0 ? Side::kInside : Side::kBoth;
}

/// How many edges of a block change sign, from those between a place's own points, which are seven of eight.
inline double crossingsWithin(const CellMask& inside) {
  constexpr double kShare = double(kBlockSize - 1) / kBlockSize;
  constexpr std::uint64_t kLastZ = 0x8080808080808080, kLastY = std::uint64_t{0xFF} << 56;
  std::uint64_t changes = 0;
  for (int x = 0; x < kBlockSize; ++x) {
    const std::uint64_t w = inside.word[x];
    changes += bitCount((w ^ w >> 1) & ~kLastZ) + bitCount((w ^ w >> 8) & ~kLastY);
    if (x > 0) changes += bitCount(w ^ inside.word[x - 1]);
  }
  return static_cast<double>(changes) / kShare;
}

/// Where those points of a part lie that are corners of the block's cells.
inline Side sideOfCorners(const CellMask& inside, int part) {
  const std::uint64_t rows =
      ((part & 2) != 0 ? 0xFF : ~std::uint64_t{0}) & ((part & 1) != 0 ? 0x0101010101010101 : ~std::uint64_t{0});
  std::uint64_t any = inside.word[0] & rows, all = inside.word[0] & rows;
  for (int x = 1; x < ((part & 4) != 0 ? 1 : kBlockSize); ++x) {
    any |= inside.word[x] & rows;
    all &= inside.word[x] & rows;
  }
  return any == 0 ? Side::kOutside : all == rows ? Side::kInside : Side::kBoth;
}

/// Joins the masks of all parts into the rows of BlockSigns.
inline void joinParts(const std::array<CellMask, kBlockParts>& part,
                      std::array<std::uint16_t, kBlockPoints * kBlockPoints>& row) {
  using Bytes = std::array<std::uint8_t, kBlockSize>;
  for (int x = 0; x < kBlockPoints; ++x) {
    const int i = (x >> 3) << 2;
    std::uint16_t* to = &row[kBlockPoints * x];
    const auto low = std::bit_cast<Bytes>(part[i].word[x & 7]), high = std::bit_cast<Bytes>(part[i | 1].word[x & 7]);
    for (int y = 0; y < kBlockSize; ++y) to[y] = static_cast<std::uint16_t>(low[y] | (high[y] & 1) << 8);
    to[kBlockSize] = static_cast<std::uint16_t>((part[i | 2].word[x & 7] & 0xFF) | (part[i | 3].word[x & 7] & 1) << 8);
  }
}

/// The sign-changing edges from a block's 8×8×8 lower points that have an end which is not known.
inline std::size_t crossingsToUnknown(const std::array<std::uint16_t, kBlockPoints * kBlockPoints>& inside,
                                      const std::array<std::uint16_t, kBlockPoints * kBlockPoints>& known) {
  std::uint64_t count = 0;
  for (int x = 0; x < kBlockSize; ++x)
    for (int y = 0; y < kBlockSize; ++y) {
      const int row = kBlockPoints * x + y;
      const auto add = [&](unsigned otherInside, unsigned otherKnown) {
        count += bitCount((inside[row] ^ otherInside) & ~(known[row] & otherKnown) & 0xFF);
      };
      add(inside[row] >> 1, known[row] >> 1);
      add(inside[row + 1], known[row + 1]);
      add(inside[row + kBlockPoints], known[row + kBlockPoints]);
    }
  return count;
}

/// The cells whose eight corners are all among a block's points that are set.
inline CellMask cellsWithAllCorners(const std::array<std::uint16_t, kBlockPoints * kBlockPoints>& points) {
  CellMask cells;
  for (int x = 0; x < kBlockSize; ++x)
    for (int y = 0; y < kBlockSize; ++y) {
      const auto row = [&](int dx, int dy) { return unsigned{points[kBlockPoints * (x + dx) + y + dy]}; };
      const unsigned all = row(0, 0) & row(0, 1) & row(1, 0) & row(1, 1);
      cells.word[x] |= std::uint64_t{all & all >> 1 & 0xFF} << 8 * y;
    }
  return cells;
}

/// Leaves out the blocks none of whose cells takes part.
inline void dropBlocksWithoutCells(SurfaceBlocks& blocks) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < blocks.coords.size(); ++i) {
    if (blocks.signs[i].cells.none()) continue;
    blocks.coords[kept] = blocks.coords[i];
    blocks.signs[kept++] = blocks.signs[i];
  }
  blocks.coords.resize(kept);
  blocks.signs.resize(kept);
}

}  // namespace pdc::detail
