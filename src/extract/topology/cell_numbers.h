#pragma once

#include <array>
#include <cstdint>

#include "pdc/sample/lattice.h"

namespace pdc::detail {

/// A number for each cell of a block and of the layer of cells about it; 0 for those that have not been given one.
class CellNumbers {
 public:
  /// The step from a cell to the next along each axis.
  static constexpr std::array<int, 3> kStep{256, 16, 1};

  void clear() { mNumber.fill(0); }
  void set(BlockCell cell, std::uint16_t number) {
    const int n = cell.number;
    mNumber[kOrigin + n + 8 * (n >> 3) + 128 * (n >> 6)] = number;
  }
  /// Points to the number of the cell whose lowest corner is `point` of the block, 256x + 16y + z; those of its
  /// neighbours lie kStep away.
  [[nodiscard]] const std::uint16_t* at(int point) const { return &mNumber[kOrigin + point]; }

 private:
  static constexpr int kOrigin = kStep[0] + kStep[1] + kStep[2];

  std::array<std::uint16_t, 10 * kStep[0]> mNumber{};
};

}  // namespace pdc::detail
