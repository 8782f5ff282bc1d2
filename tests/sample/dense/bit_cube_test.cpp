#include "sample/dense/bit_cube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace pdc::detail {
namespace {

TEST(BitCubeTest, TurnsFromAnyOrderOfAxes) {
  std::mt19937_64 random(11);
  BitCube cube;
  for (std::uint64_t& word : cube) word = random();
  std::array axes{kAxisX, kAxisY, kAxisZ};
  do {
    BitCube turned = cube;
    turnToXyz(axes, turned);
    for (int word = 0; word < 8; ++word)
      for (int byte = 0; byte < 8; ++byte)
        for (int bit = 0; bit < 8; ++bit) {
          std::array<int, 3> at{};
          at[axes[0]] = word;
          at[axes[1]] = byte;
          at[axes[2]] = bit;
          ASSERT_EQ(turned[at[0]] >> (8 * at[1] + at[2]) & 1, cube[word] >> (8 * byte + bit) & 1);
        }
  } while (std::next_permutation(axes.begin(), axes.end()));
}

}  // namespace
}  // namespace pdc::detail
