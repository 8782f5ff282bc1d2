#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "pdc/math/quadric.h"

namespace pdc::detail {

/// What the corners in a cell sum up to, about its centre, lengths in cells.
struct CellSums {
  std::uint64_t key;
  NormalEquations<double> error;
  Vec3d corners;  ///< The sum of their places.
  double count;
};

/// A list that grows without moving what it holds: it never takes twice the memory, as a vector does while it grows.
class CellSumsList {
 public:
  CellSums& operator[](std::size_t i) { return (*mChunks[i / kChunk])[i % kChunk]; }
  const CellSums& operator[](std::size_t i) const { return (*mChunks[i / kChunk])[i % kChunk]; }

  void push_back(const CellSums& sums) {
    if (mSize % kChunk == 0) mChunks.push_back(std::make_unique<Chunk>());
    (*this)[mSize++] = sums;
  }

 private:
  static constexpr std::size_t kChunk = 4096;
  using Chunk = std::array<CellSums, kChunk>;

  std::vector<std::unique_ptr<Chunk>> mChunks;
  std::size_t mSize = 0;
};

}  // namespace pdc::detail
