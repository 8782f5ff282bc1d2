#include "extract/certify/folded_blocks.h"

#include <gtest/gtest.h>

namespace pdc::detail {
namespace {

TEST(FoldedBlocks, AreThoseWithMoreThanTheMost) {
  const FoldedBlocks folded({7, 3, 7, 5, 7, 3}, 2);
  EXPECT_TRUE(folded.has(7));
  EXPECT_FALSE(folded.has(3)) << "as many as are allowed";
  EXPECT_FALSE(folded.has(5));
  EXPECT_FALSE(folded.has(4)) << "none there";
  EXPECT_FALSE(FoldedBlocks({}, 0).has(0));
}

}  // namespace
}  // namespace pdc::detail
