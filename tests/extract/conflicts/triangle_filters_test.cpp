#include "extract/conflicts/triangle_filters.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "math/lane_loops.h"
#include "pdc/math/predicates.h"
#include "simd_levels.h"

namespace pdc::detail {
namespace {

/// On a small lattice, where points often lie in one plane, or apart by little.
struct RandomPoints {
  std::mt19937 random{21};

  Vec3f operator()() {
    const auto coordinate = [this] {
      return static_cast<float>(random() % 5) + (random() % 4 == 0 ? 1e-7F * static_cast<float>(random() % 3) : 0.0F);
    };
    return {coordinate(), coordinate(), coordinate()};
  }
  TriangleCorners triangle() {
    for (;;)
      if (const TriangleCorners t{(*this)(), (*this)(), (*this)()}; !isDegenerate(t)) return t;
  }
};

TEST(TriangleFilters, CertainSidesAreThoseOfThePredicate) {
  RandomPoints point;
  int certain = 0, inPlane = 0;
  const std::vector<SimdLevel> levels = test::simdLevels();
  for (int round = 0; round < 20000; ++round) {
    const TriangleCorners t = point.triangle();
    const std::array<Vec3f, 4> corners{point(), point(), point(), point()};
    const Quad vertices{7, static_cast<std::uint32_t>(round % 6), 8, 9};
    const TrianglePlane plane({3, 4, 5}, t);
    for (const SimdLevel level : levels) {
      std::array<Sides, 4> all, others;
      withSimd(level, [&] {
        all = plane.sides(Points(corners));
        others = plane.sides(vertices, Points(corners));
      });
      for (int i = 0; i < 4; ++i) {
        const int exact = orient3d(t[0], t[1], t[2], corners[i]);
        ASSERT_TRUE(all[i].sign() == 0 || all[i].sign() == exact) << "round " << round;
        ASSERT_EQ(all[i].bits == 4, all[i].sign() == 0);
        ASSERT_EQ(others[i].bits, i == 1 && vertices[1] >= 3 ? 0 : all[i].bits);
        certain += all[i].sign() != 0;
        inPlane += exact == 0;
      }
    }
  }
  EXPECT_GT(certain, 100000);
  EXPECT_GT(inPlane, 5000);
}

TEST(TriangleFilters, ChangeNoAnswer) {
  RandomPoints point;
  std::array<int, 2> seen{};
  for (int round = 0; round < 20000; ++round) {
    const TriangleCorners a = point.triangle();
    TriangleCorners b = point.triangle();
    Triangle bVertices{3, 4, 5};
    for (int i = 0; i < round % 3; ++i) {
      b[i] = a[2 - i];
      bVertices[i] = static_cast<std::uint32_t>(2 - i);
    }
    if (isDegenerate(b)) continue;
    const bool expected = trianglesIntersect(a, {0, 1, 2}, b, bVertices);
    ASSERT_EQ(trianglesIntersect({{0, 1, 2}, a}, {bVertices, b}), expected) << "round " << round;
    ++seen[expected ? 1 : 0];
  }
  EXPECT_GT(seen[0], 2000);
  EXPECT_GT(seen[1], 2000);
}

}  // namespace
}  // namespace pdc::detail
