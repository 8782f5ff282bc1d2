#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pdc/sample/hermite_block.h"

namespace pdc::detail {

/// Finds the position of a block coordinate in a list of distinct blocks: an open-addressing hash table, filled once and then
/// read from many threads.
class BlockIndex {
 public:
  static constexpr std::int32_t kMissing = -1;

  BlockIndex() = default;
  explicit BlockIndex(const std::vector<Coord>& blocks)
      : mSlots(std::bit_ceil(2 * blocks.size() + 1), Slot{{}, kMissing}) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      std::size_t s = hash(blocks[i]) & (mSlots.size() - 1);
      while (mSlots[s].position != kMissing) s = (s + 1) & (mSlots.size() - 1);
      mSlots[s] = {blocks[i], static_cast<std::int32_t>(i)};
    }
  }

  /// Position of a block, or kMissing.
  [[nodiscard]] std::int32_t find(const Coord& block) const {
    if (mSlots.empty()) return kMissing;
    for (std::size_t s = hash(block) & (mSlots.size() - 1);; s = (s + 1) & (mSlots.size() - 1)) {
      const Coord& b = mSlots[s].block;
      if (mSlots[s].position == kMissing || (b[0] == block[0] && b[1] == block[1] && b[2] == block[2]))
        return mSlots[s].position;
    }
  }

 private:
  struct Slot {
    Coord block;
    std::int32_t position;
  };

  static std::size_t hash(const Coord& c) {
    const auto u = [](std::int32_t v) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)); };
    std::uint64_t h =
        u(c[0]) * 0x9E3779B97F4A7C15ull + u(c[1]) * 0xC2B2AE3D27D4EB4Full + u(c[2]) * 0x165667B19E3779F9ull;
    h ^= h >> 32;
    h *= 0xD6E8FEB86659FD93ull;
    return static_cast<std::size_t>(h ^ h >> 32);
  }

  std::vector<Slot> mSlots;
};

/// The block a cell or lattice point belongs to.
constexpr Coord blockOf(const Coord& cell) { return {cell[0] >> 3, cell[1] >> 3, cell[2] >> 3}; }

}  // namespace pdc::detail
