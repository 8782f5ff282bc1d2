#include "extract/topology/edge_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <vector>

namespace pdc::detail {
namespace {

TEST(EdgeSet, KnowsItsEdgesAndTheirPlaces) {
  std::mt19937 random(5);
  std::vector<EdgeRef> all, some;
  for (std::int32_t block = 0; block < 4; ++block)
    for (std::uint16_t edge = 0; edge < 3 * 512; ++edge) all.push_back({block, edge});
  // The third block has none.
  std::copy_if(all.begin(), all.end(), std::back_inserter(some),
               [&](const EdgeRef& e) { return e.block != 2 && random() % 3 == 0; });
  const EdgeSet set(4, some);
  EXPECT_EQ(set.size(), 3U);
  EXPECT_EQ(set.place(2), -1);
  for (const EdgeRef& e : all) {
    const auto at = std::lower_bound(some.begin(), some.end(), e);
    const bool there = at != some.end() && *at == e;
    ASSERT_EQ(set.has(e), there);
    if (!there) continue;
    ASSERT_EQ(set.number(e), static_cast<std::size_t>(at - some.begin()));
  }
}

}  // namespace
}  // namespace pdc::detail
