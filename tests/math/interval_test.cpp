#include "pdc/math/interval.h"

#include <gtest/gtest.h>

namespace pdc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Interval, ContainsItsEndsAndNoNan) {
  const Interval range{-1, 2};
  EXPECT_TRUE(range.contains(-1));
  EXPECT_TRUE(range.contains(2));
  EXPECT_FALSE(range.contains(-1.5));
  EXPECT_FALSE(range.contains(2.5));
  EXPECT_FALSE(range.contains(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(Interval::whole().contains(kInfinity));
}

TEST(Interval, IsBoundedByFiniteEnds) {
  EXPECT_TRUE((Interval{-1, 2}.bounded()));
  EXPECT_FALSE((Interval{-1, kInfinity}.bounded()));
  EXPECT_FALSE((Interval{-kInfinity, 2}.bounded()));
  EXPECT_FALSE(Interval::whole().bounded());
}

TEST(Interval, OperationsGiveTheRangeOfTheirResults) {
  const Interval values[] = {{-3, -1}, {-2, 4}, {0, 0}, {1, 2}};
  const auto expectRange = [](const Interval& range, double lo, double hi) {
    EXPECT_EQ(range.lo, lo);
    EXPECT_EQ(range.hi, hi);
  };
  for (const Interval& a : values) {
    expectRange(a + 0.5, a.lo + 0.5, a.hi + 0.5);
    expectRange(-a, -a.hi, -a.lo);
    for (const Interval& b : values) {
      double smallest[2] = {kInfinity, -kInfinity}, largest[2] = {kInfinity, -kInfinity};
      for (const double x : {a.lo, a.hi})
        for (const double y : {b.lo, b.hi}) {
          smallest[0] = std::min(smallest[0], std::min(x, y));
          smallest[1] = std::max(smallest[1], std::min(x, y));
          largest[0] = std::min(largest[0], std::max(x, y));
          largest[1] = std::max(largest[1], std::max(x, y));
        }
      expectRange(min(a, b), smallest[0], smallest[1]);
      expectRange(max(a, b), largest[0], largest[1]);
    }
  }
}

}  // namespace
}  // namespace pdc
