#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "pdc/sample/lattice.h"

namespace pdc::detail {

/// A number that looks random, from a block's coordinates (the finaliser of splitmix64, once for each).
inline std::uint64_t blockHash(const Coord& block) {
  std::uint64_t h = 0;
  for (int axis = 0; axis < 3; ++axis) {
    h += static_cast<std::uint32_t>(block[axis]) + 0x9E3779B97F4A7C15;
    h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9;
    h = (h ^ h >> 27) * 0x94D049BB133111EB;
    h ^= h >> 31;
  }
  return h;
}

/// A sample of blocks that does not depend on how a volume is cut: those with the smallest hashes, in the order of
/// these. The sample of a whole is made of those of its parts. \param blocks differ from each other.
inline std::vector<Coord> sampleOfBlocks(const std::vector<Coord>& blocks, std::size_t most) {
  std::vector<std::pair<std::uint64_t, Coord>> hashed;
  hashed.reserve(blocks.size());
  for (const Coord& b : blocks) hashed.emplace_back(blockHash(b), b);
  const std::size_t size = std::min(most, hashed.size());
  std::partial_sort(hashed.begin(), hashed.begin() + static_cast<std::ptrdiff_t>(size), hashed.end());
  std::vector<Coord> sample(size);
  for (std::size_t i = 0; i < size; ++i) sample[i] = hashed[i].second;
  return sample;
}

}  // namespace pdc::detail
