#include "sample/creases/octant_bytes.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

namespace pdc::detail {
namespace {

unsigned byteOf(std::uint64_t word, int k) { return static_cast<unsigned>(word >> 8 * k & 0xFF); }

TEST(OctantBytes, AreFullWhereABitIsSet) {
  for (unsigned bits = 0; bits < 256; ++bits)
    for (int k = 0; k < 8; ++k) ASSERT_EQ(byteOf(bytesOfBits(bits), k), (bits >> k & 1) != 0 ? 0xFFu : 0u) << bits;
}

TEST(OctantBytes, CountTheBitsBelow) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 1000; ++round) {
    const std::uint64_t sparse = random() & random(), word = round == 0 ? ~std::uint64_t{0} : sparse;
    unsigned below = 0;
    for (int k = 0; k < 8; ++k) {
      ASSERT_EQ(byteOf(bitsBelowEachByte(word), k), below) << word;
      below += static_cast<unsigned>(std::popcount(byteOf(word, k)));
    }
  }
}

}  // namespace
}  // namespace pdc::detail
