#pragma once

#include <array>
#include <cstdint>

namespace pdc::detail {

/// A number for each cell of a block and of the layer of cells about it; 0 for those that have not been given one.
class CellNumbers {
 public:
  /// From a cell to the next along an axis.
  static constexpr std::array<int, 3> kStep{256, 16, 1};

  void clear() { mNumber.fill(0); }
  /// \param cell of the block, 64x + 8y + z.
  void set(int cell, std::uint16_t number) { mNumber[kOrigin + cell + 8 * (cell >> 3) + 128 * (cell >> 6)] = number; }
  /// From that of the cell whose lowest corner is `point` of the block, 256x + 16y + z.
  [[nodiscard]] const std::uint16_t* at(int point) const { return &mNumber[kOrigin + point]; }

 private:
  static constexpr int kOrigin = kStep[0] + kStep[1] + kStep[2];

  std::array<std::uint16_t, 10 * kStep[0]> mNumber{};
};

}  // namespace pdc::detail
