#include "extract/topology/suspect_vertex.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pdc::detail {
namespace {

TEST(SuspectIndex, FindsThoseThereAre) {
  std::mt19937 random(6);
  std::vector<SuspectVertex> suspect;
  for (std::uint64_t vertex = 0; vertex < 1000; ++vertex)
    if (random() % 5 == 0) suspect.push_back({.vertex = vertex, .block = 0, .cell = {}, .place = {}, .safe = {}});
  const SuspectIndex index(suspect);
  std::ptrdiff_t next = 0;
  for (std::uint64_t vertex = 0; vertex < 2000; ++vertex) {
    const bool there = next < static_cast<std::ptrdiff_t>(suspect.size()) && suspect[next].vertex == vertex;
    ASSERT_EQ(index.find(vertex), there ? next++ : -1);
  }
  EXPECT_EQ(SuspectIndex({}).find(0), -1);
}

}  // namespace
}  // namespace pdc::detail
