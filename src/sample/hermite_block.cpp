#include "pdc/sample/hermite_block.h"

#include <cstring>

namespace pdc {
namespace {

/// Four rows of points side by side.
std::uint64_t rows(const BlockSigns& signs, int first) {
  std::uint64_t four;
  static_assert(sizeof four == 4 * sizeof signs.row[0]);
  std::memcpy(&four, &signs.row[static_cast<std::size_t>(first)], sizeof four);
  return four;
}

}  // namespace

EdgeIndex::EdgeIndex(const BlockSigns& signs) {
  int n = 0;
  const auto add = [&](int axis, int x, int y, unsigned bits) {
    for (; bits != 0; bits &= bits - 1) {
      const int z = std::countr_zero(bits);
      mPoint[n] = static_cast<std::uint16_t>(x << 8 | y << 4 | z);
      mNumber[slot(axis, x, y, z)] = static_cast<std::uint16_t>(n++);
    }
  };
  constexpr unsigned kLowerEnds = 0xFF;
  constexpr std::uint64_t kLowerEndsOfFour = 0x00FF00FF00FF00FF;
  for (int axis = 0; axis < 3; ++axis) {
    mStart[axis] = n;
    const int planes = axis == 0 ? kBlockSize : kBlockPoints;
    for (int x = 0; x < planes; ++x) {
      // Most rows have no edge: four are asked at once.
      const int r = kBlockPoints * x, step = axis == 0 ? kBlockPoints : axis == 1 ? 1 : 0;
      const auto any = [&](int first) {
        const std::uint64_t four = rows(signs, first);
        return axis == 2 ? (four ^ four >> 1) & kLowerEndsOfFour : four ^ rows(signs, first + step);
      };
      const auto addRow = [&](int y) {
        const unsigned here = signs.row[r + y];
        add(axis, x, y, axis == 2 ? (here ^ here >> 1) & kLowerEnds : here ^ signs.row[r + y + step]);
      };
      for (int y = 0; y < kBlockSize; y += 4)
        if (any(r + y) != 0)
          for (int i = 0; i < 4; ++i) addRow(y + i);
      if (axis != 1) addRow(kBlockSize);
    }
  }
  mStart[3] = n;
}

}  // namespace pdc
