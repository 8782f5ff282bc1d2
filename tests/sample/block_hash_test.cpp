#include "sample/block_hash.h"

#include <gtest/gtest.h>

#include <set>

namespace pdc::detail {
namespace {

std::vector<Coord> cube(int from, int to) {
  std::vector<Coord> blocks;
  for (int x = from; x < to; ++x)
    for (int y = from; y < to; ++y)
      for (int z = from; z < to; ++z) blocks.push_back({x, y, z});
  return blocks;
}

TEST(BlockHash, BlocksNearTheOriginAllDiffer) {
  std::set<std::uint64_t> hashes;
  for (const Coord& b : cube(-20, 20)) hashes.insert(blockHash(b));
  EXPECT_EQ(hashes.size(), 64000U);
  EXPECT_NE(blockHash({1, 2, 3}), blockHash({3, 2, 1}));
}

TEST(BlockHash, TheSampleOfAWholeIsMadeOfThoseOfItsParts) {
  const std::vector<Coord> all = cube(-8, 8);
  const std::vector<Coord> sample = sampleOfBlocks(all, 64);
  ASSERT_EQ(sample.size(), 64U);
  std::vector<Coord> ofParts;
  for (std::size_t begin = 0; begin < all.size(); begin += 1000) {
    const std::vector<Coord> part(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                  all.begin() + static_cast<std::ptrdiff_t>(std::min(begin + 1000, all.size())));
    const std::vector<Coord> some = sampleOfBlocks(part, 64);
    ofParts.insert(ofParts.end(), some.begin(), some.end());
  }
  EXPECT_EQ(sampleOfBlocks(ofParts, 64), sample);
}

TEST(BlockHash, ASampleIsSpreadOverTheWhole) {
  int octants[8] = {};
  for (const Coord& b : sampleOfBlocks(cube(-8, 8), 400)) ++octants[(b[0] < 0) * 4 + (b[1] < 0) * 2 + (b[2] < 0)];
  for (const int count : octants) EXPECT_GT(count, 25);
}

TEST(BlockHash, ASmallWholeIsTakenWhole) { EXPECT_EQ(sampleOfBlocks(cube(0, 2), 64).size(), 8U); }

}  // namespace
}  // namespace pdc::detail
