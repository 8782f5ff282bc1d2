#include "field/interval_arithmetic.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "field/field_checks.h"

namespace pdc::detail {
namespace {

using test::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<Interval> ranges() { return {{-3, -1}, {-2, 4}, {0, 0}, {0, 2}, {-1, 0}, {1, 2.5}}; }

/// Expects that `range` holds operation(x, y) for all x and y of a and b, and is no wider than these values.
template <typename Operation>
void expectTight(const Interval& range, const Interval& a, const Interval& b, const Operation& operation) {
  constexpr int kSteps = 24;
  Interval seen{kInfinity, -kInfinity};
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const double v = operation(a.lo + (a.hi - a.lo) * i / kSteps, b.lo + (b.hi - b.lo) * j / kSteps);
      seen = hull(seen, {v, v});
    }
  EXPECT_NEAR(range.lo, seen.lo, 1e-12);
  EXPECT_NEAR(range.hi, seen.hi, 1e-12);
}

TEST(IntervalArithmetic, RangesAreThoseOfTheResults) {
  for (const Interval& a : ranges()) {
    expectTight(absolute(a), a, a, [](double x, double) { return std::abs(x); });
    expectTight(product(a, 1.5), a, a, [](double x, double) { return 1.5 * x; });
    for (const Interval& b : ranges()) {
      expectTight(sum(a, b), a, b, [](double x, double y) { return x + y; });
      expectTight(difference(a, b), a, b, [](double x, double y) { return x - y; });
      expectTight(product(a, b), a, b, [](double x, double y) { return x * y; });
    }
  }
}

TEST(IntervalArithmetic, WidensByTheSlackAndForgetsNan) {
  const Interval wide = widened({-1, 2}, 10);
  EXPECT_DOUBLE_EQ(wide.lo, -1 - 11 * kRoundingSlack);
  EXPECT_DOUBLE_EQ(wide.hi, 2 + 12 * kRoundingSlack);
  for (const Interval& bad : {Interval{kNan, 1}, Interval{0, kNan}, Interval{1, -1}})
    EXPECT_FALSE(widened(bad, 1).bounded());
}

TEST(IntervalArithmetic, LipschitzBoundHoldsAndIsTight) {
  const Box box{{1, 2, 3}, {2, 4, 5}};
  const Interval bound = lipschitzBound(0.5, 2, box);
  EXPECT_NEAR(bound.lo, 0.5 - 3, 1e-10);
  EXPECT_NEAR(bound.hi, 0.5 + 3, 1e-10);
  EXPECT_LT(bound.lo, 0.5 - 3);
  EXPECT_GT(bound.hi, 0.5 + 3);
  for (const double bad : {kNan, kInfinity, -kInfinity}) EXPECT_FALSE(lipschitzBound(bad, 2, box).bounded());
}

TEST(IntervalArithmetic, DistancesAndExtentsAreThoseOfTheBox) {
  Random random(1);
  const Box region{{-2, -2, -2}, {2, 2, 2}};
  for (int i = 0; i < 200; ++i) {
    const Box box = random.boxIn(region, 0.1, 3);
    const Vec3d center = random.in(region), direction = random.in(region);
    const AxisDistances distances(box, center);
    double reach = 0;
    Vec3d near{kInfinity, kInfinity, kInfinity}, far{};
    for (int k = 0; k < 8; ++k) {
      const Vec3d p = corner(box, k);
      reach = std::max(reach, std::abs(dot(direction, p - box.center())));
      for (int axis = 0; axis < 3; ++axis) {
        far[axis] = std::max(far[axis], std::abs(p[axis] - center[axis]));
        near[axis] = std::min(near[axis], std::abs(p[axis] - center[axis]));
      }
    }
    ASSERT_NEAR(extent(box, direction), reach, 1e-12);
    for (int axis = 0; axis < 3; ++axis) {
      const bool within = box.lo[axis] <= center[axis] && center[axis] <= box.hi[axis];
      ASSERT_EQ(distances.near[axis], within ? 0 : near[axis]);
      ASSERT_EQ(distances.far[axis], far[axis]);
    }
  }
}

}  // namespace
}  // namespace pdc::detail
