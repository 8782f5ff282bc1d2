#include "sample/dense/key_ranges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace pdc::detail {
namespace {

/// Compares the bounds with what values mean, for every stored value of 16 bits.
template <typename Scalar>
void expectExact(double slope, double intercept, const ValueReading& reading) {
  const ValueBounds<Scalar> bounds(slope, intercept, reading);
  for (int i = 0; i < 1 << 16; ++i) {
    const auto raw = static_cast<typename Scalar::Raw>(i);
    const double v = slope * static_cast<double>(Scalar::number(raw)) + intercept;
    const bool finite = std::isfinite(v);
    ASSERT_EQ(bounds.finite.holds(Scalar::key(raw)), finite) << i;
    ASSERT_EQ(bounds.inside.holds(Scalar::key(raw)),
              finite && (reading.insideIsHigher ? v > reading.iso : v < reading.iso))
        << i;
    ASSERT_EQ(bounds.onIso.holds(Scalar::key(raw)), finite && v == reading.iso) << i;
  }
}

TEST(ValueBoundsTest, SayWhatValuesMean) {
  for (const double slope : {1.0, -1.0, 0.125, -3.7})
    for (const double iso : {0.0, 12.0, -17.3, 1e9})
      for (const bool higher : {false, true}) {
        const ValueReading reading{.iso = iso, .insideIsHigher = higher};
        expectExact<PlainScalar<std::int16_t>>(slope, 0, reading);
        expectExact<PlainScalar<std::uint16_t>>(slope, 12, reading);
        expectExact<PlainScalar<std::uint8_t>>(slope, -4, reading);
        expectExact<BoolScalar>(slope, 11, reading);
        expectExact<HalfScalar>(slope, 0, reading);
      }
}

TEST(ValueBoundsTest, FloatsWithoutANumberAreNowhere) {
  const ValueBounds<PlainScalar<float>> low(1, 0, {.iso = 0.5}), high(1, 0, {.iso = 0.5, .insideIsHigher = true});
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNaN = std::numeric_limits<float>::quiet_NaN();
  for (const float v : {-kInfinity, kInfinity, kNaN}) {
    EXPECT_FALSE(low.finite.holds(v));
    EXPECT_FALSE(low.inside.holds(v));
    EXPECT_FALSE(high.inside.holds(v));
  }
  EXPECT_TRUE(low.inside.holds(std::numeric_limits<float>::lowest()));
  EXPECT_TRUE(low.inside.holds(std::nextafter(0.5F, 0.0F)));
  EXPECT_FALSE(low.inside.holds(0.5F));
  EXPECT_TRUE(low.onIso.holds(0.5F));
  EXPECT_TRUE(high.inside.holds(std::nextafter(0.5F, 1.0F)));
}

TEST(ValueBoundsTest, BothZerosAreZero) {
  const ValueBounds<PlainScalar<double>> bounds(1, 0, {});
  EXPECT_TRUE(bounds.onIso.holds(-0.0));
  EXPECT_TRUE(bounds.onIso.holds(0.0));
  EXPECT_FALSE(bounds.inside.holds(-0.0));
}

TEST(ValueBoundsTest, LargeWholeNumbersKeepTheirOrder) {
  constexpr std::int64_t kLarge = std::int64_t{1} << 60;
  const ValueBounds<PlainScalar<std::int64_t>> bounds(1, 0, {.iso = double(kLarge)});
  EXPECT_TRUE(bounds.inside.holds(std::numeric_limits<std::int64_t>::lowest()));
  EXPECT_TRUE(bounds.inside.holds(kLarge - 1000));
  EXPECT_TRUE(bounds.onIso.holds(kLarge));
  EXPECT_FALSE(bounds.inside.holds(kLarge));
  const ValueBounds<PlainScalar<std::uint64_t>> all(1, 0, {.iso = -1, .insideIsHigher = true});
  EXPECT_TRUE(all.inside.holds(0));
  EXPECT_TRUE(all.inside.holds(std::numeric_limits<std::uint64_t>::max()));
}

TEST(HalfScalarTest, NumbersAreThoseOfTheStandard) {
  EXPECT_EQ(HalfScalar::number(0x3C00), 1.0F);
  EXPECT_EQ(HalfScalar::number(0xC000), -2.0F);
  EXPECT_EQ(HalfScalar::number(0x7BFF), 65504.0F);
  EXPECT_EQ(HalfScalar::number(0x0001), 0x1p-24F);
  EXPECT_EQ(HalfScalar::number(0x3555), 0.333251953125F);
  EXPECT_TRUE(std::isinf(HalfScalar::number(0x7C00)));
  EXPECT_TRUE(std::isnan(HalfScalar::number(0x7E01)));
}

}  // namespace
}  // namespace pdc::detail
