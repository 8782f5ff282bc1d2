#include "math/word_bits.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pdc::detail {
namespace {

template <int kAtOnce>
void expectBits(std::uint64_t word) {
  std::vector<int> bits;
  int vain = 0;
  const int count = writeBits<kAtOnce>(word, [&](int i, int bit) {
    ASSERT_EQ(i, static_cast<int>(bits.size()) + vain);
    if (bit == 64) {
      ++vain;
    } else {
      ASSERT_EQ(vain, 0);
      bits.push_back(bit);
    }
  });
  std::vector<int> expected;
  for (int bit = 0; bit < 64; ++bit)
    if ((word >> bit & 1) != 0) expected.push_back(bit);
  ASSERT_EQ(bits, expected);
  ASSERT_EQ(count, static_cast<int>(expected.size()));
  ASSERT_LE(vain, kAtOnce);
}

TEST(WriteBits, VisitsSetBitsInOrderThenAFewInVain) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t some = random() & random(), few = some & random() & random();
    for (const std::uint64_t word : {some, few, some | few << 1, std::uint64_t{1} << i % 64}) {
      expectBits<2>(word);
      expectBits<4>(word);
      expectBits<8>(word);
    }
  }
  expectBits<4>(0);
  expectBits<4>(~std::uint64_t{0});
}

}  // namespace
}  // namespace pdc::detail
