#include "math/lane_loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "math/float_lanes.h"
#include "simd_levels.h"

namespace pdc::detail {
namespace {

TEST(LaneLoops, VisitEveryBatchAndLaneOnceAtEveryLevel) {
  for (const SimdLevel level : test::simdLevels()) {
    std::vector<std::array<int, kLanes>> visits(5);
    forEachBatch(level, visits.size(), [&](std::size_t i) { forEachLane([&](int lane) { ++visits[i][lane]; }); });
    for (const auto& batch : visits)
      for (const int count : batch) EXPECT_EQ(count, 1);
    forEachBatch(level, 0, [](std::size_t) { ADD_FAILURE(); });
    int calls = 0;
    withSimd(level, [&] { ++calls; });
    EXPECT_EQ(calls, 1);
  }
}

TEST(LaneLoops, VisitAsFewLanesAsTheyAreTold) {
  std::array<int, kLanes> visits{};
  forEachLane<3>([&](int lane) { ++visits[lane]; });
  for (int lane = 0; lane < kLanes; ++lane) EXPECT_EQ(visits[lane], lane < 3);
}

TEST(FoldLanes, AddsInOneOrderOnly) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    std::array<float, kLanes> lanes, halves;
    for (float& v : lanes) v = uniform(random);
    halves = lanes;
    for (int width = kLanes / 2; width > 0; width /= 2)
      for (int lane = 0; lane < width; ++lane) halves[lane] += halves[lane + width];
    ASSERT_EQ(sumLanes(lanes.data()), halves[0]);
  }
}

TEST(FoldLanes, FindsExtremesInAnyLane) {
  for (int lane = 0; lane < kLanes; ++lane) {
    std::array<float, kLanes> floats;
    std::array<std::int32_t, kLanes> integers;
    floats.fill(-2);
    integers.fill(7);
    floats[lane] = -1;
    integers[lane] = -7;
    EXPECT_EQ(maxLanes(floats.data()), -1);
    EXPECT_EQ(minLanes(integers.data()), -7);
  }
}

TEST(Transpose4, MakesColumnsOfRowsAndLeavesTheRestAlone) {
  constexpr std::size_t kFromStep = 5, kToStep = 7;
  std::array<float, 4 * kFromStep> from;
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<float>(i);
  std::array<float, 4 * kToStep> to;
  to.fill(-1);
  transpose4(from.data(), kFromStep, to.data(), kToStep);
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < kToStep; ++column)
      EXPECT_EQ(to[row * kToStep + column], column < 4 ? from[column * kFromStep + row] : -1) << row << ' ' << column;
}

}  // namespace
}  // namespace pdc::detail
