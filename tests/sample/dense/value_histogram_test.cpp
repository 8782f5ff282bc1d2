#include "pdc/sample/dense/value_histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "sample/dense/volumes.h"

namespace pdc {
namespace {

using test::makeVolume;
using test::Volume;

TEST(ValueHistogramTest, CountsWhatValuesMean) {
  Volume volume = makeVolume<std::int16_t>({4, 5, 6}, [](std::int64_t x, std::int64_t, std::int64_t) { return x; });
  volume.form.slope = -2;
  volume.form.intercept = 10;
  const ValueHistogram h = valueHistogram(volume.view(), 4);
  EXPECT_EQ(h.lowest, 4);
  EXPECT_EQ(h.highest, 10);
  EXPECT_EQ(h.finite, 120U);
  EXPECT_EQ(h.nonFinite, 0U);
  EXPECT_EQ(h.between, 60U);
  EXPECT_EQ(h.width(), 1.5);
  EXPECT_EQ(h.count, (std::vector<std::uint64_t>{30, 30, 30, 30}));
}

TEST(ValueHistogramTest, LeavesOutWhatIsNotFinite) {
  const auto values = [](std::int64_t x, std::int64_t y, std::int64_t) {
    return x == 0 ? (y == 0 ? std::nan("") : std::numeric_limits<double>::infinity()) : double(x);
  };
  const ValueHistogram h = valueHistogram(makeVolume<float>({3, 2, 2}, values).view(), 2);
  EXPECT_EQ(h.lowest, 1);
  EXPECT_EQ(h.highest, 2);
  EXPECT_EQ(h.finite, 8U);
  EXPECT_EQ(h.nonFinite, 4U);
}

TEST(ValueHistogramTest, CountsWhereTheMaskHasData) {
  const Volume volume = makeVolume<float>({3, 2, 2}, [](std::int64_t x, auto, auto) { return x; });
  const Volume some = makeVolume<bool>({3, 2, 2}, [](std::int64_t x, auto, auto) { return x > 0 ? 1 : 0; });
  const VolumeView view = some.view();
  EXPECT_EQ(valueHistogram(volume.view(), 2, {}, &view).lowest, 1);
  EXPECT_EQ(valueHistogram(volume.view(), 2, {}, &view).finite, 8U);
}

TEST(ValueHistogramTest, IsTheSameForAllLayouts) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(5, 2);
  std::vector<double> values(13 * 14 * 15);
  for (double& v : values) v = noise(random);
  const auto value = [&](std::int64_t x, std::int64_t y, std::int64_t z) { return values[(x * 14 + y) * 15 + z]; };
  const ValueHistogram a = valueHistogram(makeVolume<float>({13, 14, 15}, value).view(), 50);
  const ValueHistogram b = valueHistogram(
      makeVolume<float>({13, 14, 15}, value, {.order = {2, 0, 1}, .reversed = {true, true, false}, .swapped = true})
          .view(),
      50);
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.lowest, b.lowest);
  EXPECT_THROW(static_cast<void>(valueHistogram(makeVolume<float>({1, 1, 1}, value).view(), 0)), std::invalid_argument);
}

TEST(OtsuThresholdTest, PartsTwoValuesHalfWay) {
  const Volume volume =
      makeVolume<std::uint8_t>({6, 6, 6}, [](std::int64_t x, auto, auto) { return x < 4 ? 20 : 220; });
  const std::optional<OtsuThreshold> threshold = otsuThreshold(volume.view());
  ASSERT_TRUE(threshold);
  EXPECT_NEAR(threshold->value, 120, 0.2);
  EXPECT_NEAR(threshold->separation, 1, 1e-6);
}

TEST(OtsuThresholdTest, PartsTwoNoisyClasses) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 1);
  const Volume volume = makeVolume<float>(
      {30, 30, 30}, [&](std::int64_t x, auto, auto) { return (x < 12 ? 10.0 : 18.0) + noise(random); });
  const std::optional<OtsuThreshold> threshold = otsuThreshold(volume.view());
  ASSERT_TRUE(threshold);
  EXPECT_NEAR(threshold->value, 14, 0.6);
  // Classes 8 apart, 0.4 and 0.6 of all, have a variance of 0.24 · 64 between them, and 1 within.
  EXPECT_NEAR(threshold->separation, 0.24 * 64 / (0.24 * 64 + 1), 0.01);
}

TEST(OtsuThresholdTest, ValuesThatAreSpreadEvenlyArePartedInTheMiddle) {
  const Volume volume = makeVolume<float>({1000, 2, 2}, [](std::int64_t x, auto, auto) { return double(x); });
  const std::optional<OtsuThreshold> threshold = otsuThreshold(volume.view());
  ASSERT_TRUE(threshold);
  EXPECT_NEAR(threshold->value, 499.5, 2);
  EXPECT_NEAR(threshold->separation, 0.75, 0.01);
}

TEST(OtsuThresholdTest, OneValueHasNone) {
  EXPECT_FALSE(otsuThreshold(makeVolume<float>({3, 3, 3}, [](auto, auto, auto) { return 2; }).view()));
}

}  // namespace
}  // namespace pdc
