#include "field/primitives/sine_cosine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace pdc::detail {
namespace {

TEST(SineCosine, IsWithinItsErrorOfTheTrueValues) {
  std::mt19937_64 random(1);
  for (const double most : {1.0, 30.0, 1e4, 1e8, 1e12}) {
    std::uniform_real_distribution<double> angle(-most, most);
    for (int i = 0; i < 100000; ++i) {
      const double x = angle(random), error = 3e-16 + std::abs(x) * 0x1p-52;
      const SineCosine f = sineCosine(x);
      ASSERT_NEAR(f.sine, std::sin(x), error) << x;
      ASSERT_NEAR(f.cosine, std::cos(x), error) << x;
    }
  }
}

TEST(SineCosine, MultiplesOfQuarterTurnsAreInTheirQuadrants) {
  for (int k = -1000; k <= 1000; ++k) {
    const double x = k * std::acos(0.0);
    EXPECT_NEAR(sineCosine(x).sine, std::sin(x), 3e-16) << k;
    EXPECT_NEAR(sineCosine(x).cosine, std::cos(x), 3e-16) << k;
  }
  EXPECT_EQ(sineCosine(0).sine, 0);
  EXPECT_EQ(sineCosine(0).cosine, 1);
}

TEST(SineCosine, NothingIsOutsideTheUnitIntervalHoweverLarge) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(0, 308);
  for (int i = 0; i < 100000; ++i) {
    const double x = std::pow(10, exponent(random));
    ASSERT_LE(std::abs(sineCosine(x).sine), 1) << x;
    ASSERT_LE(std::abs(sineCosine(x).cosine), 1) << x;
  }
}

TEST(SineCosine, OfWhatIsNoNumberIsNone) {
  EXPECT_TRUE(std::isnan(sineCosine(std::numeric_limits<double>::quiet_NaN()).sine));
}

}  // namespace
}  // namespace pdc::detail
