#include "mesh/oriented_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pdc::detail {
namespace {

TriangleCorners sliverAt(const Vec3f& middle, const Vec3f& along) {
  return {middle - along, middle + along, middle + Vec3f{0, 0, 0.01f}};
}

OrientedBox boxAround(const TriangleCorners& t) {
  const std::array<Vec3d, 3> points{vecCast<double>(t[0]), vecCast<double>(t[1]), vecCast<double>(t[2])};
  return {axesAlong(t), points, 0};
}

TEST(OrientedBox, IsThinAroundASliver) {
  const OrientedBox box = boxAround(sliverAt({5, 5, 5}, {1, 1, 0}));
  EXPECT_NEAR(box.half.x, std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(box.half.y, 0.005, 1e-6);
  EXPECT_LT(box.half.z, 1e-11);
}

TEST(OrientedBox, SeparatesSliversSideBySide) {
  const OrientedBox box = boxAround(sliverAt({0, 0, 0}, {1, 1, 0}));
  EXPECT_TRUE(box.apartFrom(boxAround(sliverAt({0.1f, -0.1f, 0}, {1, 1, 0}))));
  EXPECT_TRUE(box.apartFrom(OrientedBox(BoxF{{0.5f, -0.5f, -1}, {0.7f, -0.3f, 1}})));
  EXPECT_FALSE(box.apartFrom(boxAround(sliverAt({0, 0, 0.01f}, {1, 1, 0}))));
}

TEST(OrientedBox, IsNeverApartFromWhatItMeets) {
  std::mt19937 random(34);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (int i = 0; i < 10'000; ++i) {
    const float scale = std::pow(10.0f, 15 * uniform(random)), offset = i % 2 == 0 ? 0 : scale * 1e6f;
    const auto point = [&] {
      return Vec3f{offset + scale * uniform(random), scale * uniform(random), scale * uniform(random)};
    };
    const Vec3f common = point();
    const OrientedBox a = boxAround({common, point(), point()}), b = boxAround({point(), common, point()});
    EXPECT_FALSE(a.apartFrom(b));
    EXPECT_FALSE(b.apartFrom(a));
    EXPECT_FALSE(a.apartFrom(OrientedBox(BoxF{common, common})));
  }
}

TEST(OrientedBox, HasAxesForPointsAndLines) {
  for (const TriangleCorners& t :
       {TriangleCorners{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}}, TriangleCorners{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}}) {
    const OrientedBox::Axes axes = axesAlong(t);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(dot(axes[i], axes[k]), i == k ? 1 : 0, 1e-12);
  }
}

TEST(OrientedBox, SliversAreLongAndLow) {
  EXPECT_TRUE(isSliver({{{0, 0, 0}, {17, 0, 0}, {5, 1, 0}}}));
  EXPECT_FALSE(isSliver({{{0, 0, 0}, {15, 0, 0}, {5, 0, 1}}}));
  EXPECT_FALSE(isSliver({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}));
}

}  // namespace
}  // namespace pdc::detail
