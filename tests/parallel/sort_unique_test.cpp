#include "parallel/sort_unique.h"

#include <gtest/gtest.h>

namespace pdc::detail {
namespace {

TEST(SortUnique, SortsAndDropsWhatIsThereTwice) {
  std::vector<int> list{3, 1, 3, 2, 1, 3};
  sortUnique(list);
  EXPECT_EQ(list, (std::vector<int>{1, 2, 3}));
  std::vector<int> none;
  sortUnique(none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace pdc::detail
