#include "pdc/sample/hermite_block.h"

#include "math/lane_loops.h"
#include "math/word_bits.h"

namespace pdc {
namespace {

/// The rows of a plane of points that fit into a word.
constexpr int kRowsPerWord = 64 / kBlockPoints;

/// 16y + z of each of a plane's points, with room for bits beyond the last of a word.
constexpr auto kPlanePoint = [] {
  std::array<std::uint16_t, kRowsPerWord * kBlockPoints + 65> point{};
  for (int i = 0; i < kBlockPoints * kBlockPoints; ++i)
    point[i] = static_cast<std::uint16_t>(i / kBlockPoints << 4 | i % kBlockPoints);
  return point;
}();

}  // namespace

EdgeIndex::EdgeIndex(const BlockSigns& signs) {
  detail::withSimd(bestSimdLevel(), [&] { fill(signs); });
}

void EdgeIndex::fill(const BlockSigns& signs) {
  int n = 0;
  // Numbers the edges along `axis` whose low ends are in a plane; rowBits(y) says which of a row change sign.
  const auto addPlane = [&](Axis axis, int x, auto&& rowBits) {
    for (int first = 0; first < kBlockPoints; first += kRowsPerWord) {
      std::uint64_t word = 0;
      for (int y = first; y < kBlockPoints && y < first + kRowsPerWord; ++y)
        word |= std::uint64_t{rowBits(y)} << (kBlockPoints * (y - first));
      std::uint16_t* number = &mNumber[slot(axis, x, first, 0)];
      const std::uint16_t* point = &kPlanePoint[kBlockPoints * first];
      // Most words have two edges or fewer.
      n += detail::writeBits<2>(word, [&](int i, int bit) {
        mPoint[n + i] = static_cast<std::uint16_t>(x << 8 | point[bit]);
        number[bit] = static_cast<std::uint16_t>(n + i);
      });
    }
  };
  constexpr unsigned kLowerEnds = 0xFF;
  const auto& row = signs.row;
  for (int x = 0; x < kBlockSize; ++x) {
    const std::uint16_t* r = &row[kBlockPoints * x];
    addPlane(kAxisX, x, [r](int y) -> unsigned { return r[y] ^ r[y + kBlockPoints]; });
  }
  mStart[1] = n;
  for (int x = 0; x < kBlockPoints; ++x) {
    const std::uint16_t* r = &row[kBlockPoints * x];
    addPlane(kAxisY, x, [r](int y) -> unsigned { return y < kBlockSize ? r[y] ^ r[y + 1] : 0; });
  }
  mStart[2] = n;
  for (int x = 0; x < kBlockPoints; ++x) {
    const std::uint16_t* r = &row[kBlockPoints * x];
    addPlane(kAxisZ, x, [r](int y) -> unsigned { return (r[y] ^ r[y] >> 1) & kLowerEnds; });
  }
  mStart[3] = n;
}

}  // namespace pdc
