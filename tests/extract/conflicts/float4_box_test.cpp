#include "extract/conflicts/float4_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace pdc::detail {
namespace {

Float4Box boxOf(const Vec3f& low, const Vec3f& high) { return Float4Box(std::array{low, high}); }

TEST(Float4Box, HoldsItsPoints) {
  const Float4Box box(std::array{Vec3f{1, 5, -2}, Vec3f{3, 4, 0}, Vec3f{2, 6, -1}});
  EXPECT_EQ(vec3(box.low), (Vec3f{1, 4, -2}));
  EXPECT_EQ(vec3(box.high), (Vec3f{3, 6, 0}));
  Float4Box both = box;
  both.add(boxOf({0, 5, -1}, {2, 7, -1}));
  EXPECT_EQ(vec3(both.low), (Vec3f{0, 4, -2}));
  EXPECT_EQ(vec3(both.high), (Vec3f{3, 7, 0}));
  EXPECT_TRUE(both.contains(box));
  EXPECT_FALSE(box.contains(both));
  EXPECT_TRUE(box.contains(box));
}

TEST(Float4Box, IsApartAlongAnyAxis) {
  const Float4Box box = boxOf({0, 0, 0}, {1, 1, 1});
  EXPECT_FALSE(box.apartFrom(boxOf({1, 1, 1}, {2, 2, 2}))) << "they touch";
  for (int axis = 0; axis < 3; ++axis)
    for (const float step : {-1.5F, 1.5F}) {
      Vec3f low{0, 0, 0}, high{1, 1, 1};
      low[axis] += step;
      high[axis] += step;
      EXPECT_TRUE(box.apartFrom(boxOf(low, high)));
      EXPECT_TRUE(boxOf(low, high).apartFrom(box));
      EXPECT_FALSE(box.contains(boxOf(low, high)));
    }
}

TEST(Float4Box, WithRoundingHoldsTheNextFloats) {
  std::mt19937 random(21);
  std::uniform_real_distribution<float> coordinate(-5, 5);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (int round = 0; round < 1000; ++round) {
    const std::array<Vec3f, 2> points{Vec3f{coordinate(random), coordinate(random), coordinate(random)},
                                      Vec3f{coordinate(random), coordinate(random), coordinate(random)}};
    Float4Box box(points);
    box.addRounding();
    for (const Vec3f& p : points)
      for (int i = 0; i < 3; ++i)
        for (const float to : {-kInfinity, kInfinity}) {
          Vec3f next = p;
          next[i] = std::nextafter(p[i], to);
          ASSERT_TRUE(box.contains(Float4Box(std::array{next}))) << "round " << round;
        }
  }
}

}  // namespace
}  // namespace pdc::detail
