#include "pdc/sample/hermite_block.h"

namespace pdc {

EdgeIndex::EdgeIndex(const BlockSigns& signs) {
  constexpr unsigned kLowerEnds = 0xFF;
  int n = 0;
  const auto add = [&](int axis, int r, unsigned bits) {
    mRow[axis][r] = static_cast<std::uint16_t>(bits);
    mStart[axis][r] = static_cast<std::uint16_t>(n);
    n += kBitCount[bits];
  };
  for (int r = 0; r < kBlockPoints * kBlockSize; ++r) add(0, r, signs.row[r] ^ unsigned{signs.row[r + kBlockPoints]});
  for (int x = 0; x < kBlockPoints; ++x)
    for (int r = kBlockPoints * x; r < kBlockPoints * x + kBlockSize; ++r)
      add(1, r, signs.row[r] ^ unsigned{signs.row[r + 1]});
  for (int r = 0; r < kBlockPoints * kBlockPoints; ++r)
    add(2, r, (signs.row[r] ^ (unsigned{signs.row[r]} >> 1)) & kLowerEnds);
  mSize = n;
}

}  // namespace pdc
