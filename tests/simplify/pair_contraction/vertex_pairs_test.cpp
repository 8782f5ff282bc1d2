#include "simplify/pair_contraction/vertex_pairs.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <set>

namespace pdc::detail {
namespace {

using Pairs = std::map<std::array<std::uint32_t, 2>, bool>;  ///< Whether they are close, by vertices in order.

Pairs pairsOf(VertexPairs& pairs, std::uint32_t vertices) {
  Pairs found;
  for (std::uint32_t v = 0; v < vertices; ++v)
    pairs.forEach(v, [&](std::uint32_t p, std::uint32_t other) {
      EXPECT_EQ((std::array{pairs.lower(p), pairs.higher(p)}), (std::array{std::min(v, other), std::max(v, other)}));
      found[{std::min(v, other), std::max(v, other)}] = pairs.isClose(p);
    });
  return found;
}

TEST(VertexPairs, MergeAsSetsOfPairsDo) {
  constexpr std::uint32_t kVertices = 40;
  std::mt19937 engine(1);
  const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
  VertexPairs pairs(kVertices);
  VertexMarks marks(kVertices);
  Pairs expected;
  for (int i = 0; i < 200; ++i) {
    const std::uint32_t a = random() % kVertices, b = random() % kVertices;
    if (a == b || expected.contains({std::min(a, b), std::max(a, b)})) continue;
    const bool close = random() % 2 == 0;
    pairs.add(a, b, close);
    expected[{std::min(a, b), std::max(a, b)}] = close;
  }
  for (std::uint32_t b = kVertices - 1; b > 5; --b) {
    const std::uint32_t a = random() % b;
    pairs.merge(a, b, marks);
    Pairs merged;
    for (const auto& [ends, close] : expected) {
      const std::uint32_t low = ends[0] == b ? a : ends[0], high = ends[1] == b ? a : ends[1];
      if (low == high) continue;
      bool& isClose = merged[{std::min(low, high), std::max(low, high)}];
      isClose = isClose || close;
    }
    expected = merged;
    ASSERT_EQ(pairsOf(pairs, kVertices), expected) << b;
  }
}

}  // namespace
}  // namespace pdc::detail
