#include "mesh/intersections/stand_ins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pdc::detail {
namespace {

Vec3d unit(const Vec3d& v) { return v * (1 / length(v)); }

/// Weights of three corners that make p, which lies in their plane.
Vec3d weights(const TriangleCorners& t, const Vec3d& p) {
  const Vec3d a = vecCast<double>(t[0]), b = vecCast<double>(t[1]), c = vecCast<double>(t[2]);
  const Vec3d n = cross(b - a, c - a);
  const auto part = [&](const Vec3d& q, const Vec3d& r) { return dot(cross(q - p, r - p), n) / dot(n, n); };
  return {part(b, c), part(c, a), part(a, b)};
}

TEST(StandIns, ContainTheArc) {
  std::mt19937 random(35);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto point = [&] { return Vec3f{uniform(random), uniform(random), uniform(random)}; };
  int arcs = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3f hub = point(), a = point(), b = point();
    const auto arc = arcStandIn(hub, a, b);
    if (!arc) continue;
    ++arcs;
    for (const float t : {0.0f, 0.1f, 0.5f, 0.8f, 1.0f}) {
      const Vec3d direction = unit(vecCast<double>(a * (1 - t) + b * t - hub));
      const Vec3d w = weights(*arc, direction);
      for (int k = 0; k < 3; ++k) EXPECT_GT(w[k], -1e-3);
      EXPECT_LT(
          std::abs(dot(direction - vecCast<double>((*arc)[0]),
                       unit(cross(vecCast<double>((*arc)[1] - (*arc)[0]), vecCast<double>((*arc)[2] - (*arc)[0]))))),
          1e-5);
    }
  }
  EXPECT_GT(arcs, 950);
}

TEST(StandIns, AreMissingWhereRoundingDecides) {
  EXPECT_FALSE(arcStandIn({0, 0, 0}, {1, 0.001f, 0}, {-1, 0, 0}));
  EXPECT_TRUE(arcStandIn({0, 0, 0}, {1, 0.1f, 0}, {-1, 0, 0}));
  EXPECT_FALSE(pageStandIn({0, 0, 0}, {0, 0, 1}, {1e-10f, 0, 1}));
  EXPECT_TRUE(pageStandIn({0, 0, 0}, {0, 0, 1}, {1e-6f, 0, 1}));
}

TEST(StandIns, ArePointsForPages) {
  const auto page = pageStandIn({1, 1, 1}, {1, 1, 3}, {1, 5, -20});
  ASSERT_TRUE(page);
  for (const Vec3f& corner : *page) EXPECT_EQ(corner, (Vec3f{-1, 0, 0}));
}

}  // namespace
}  // namespace pdc::detail
