#include "pdc/field/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "field/field_checks.h"

namespace pdc {
namespace {

using test::FieldCase;
using test::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const Box kRegion{{-40, -40, -40}, {40, 40, 40}};

std::vector<FieldCase> noises() {
  return {{"oneOctave", simplexNoise({.octaves = 1}), false, 7, kRegion},
          {"fourOctaves", simplexNoise({.seed = 5, .frequency = 0.3}), false, 9, kRegion},
          {"rough", simplexNoise({.octaves = 3, .frequency = 0.2, .gain = 0.9, .lacunarity = 1.7, .amplitude = 0.4}),
           false, 5},
          {"silent", simplexNoise({.amplitude = 0}), false, 0}};
}

class Noise : public testing::TestWithParam<FieldCase> {};

TEST_P(Noise, GradientsMatchDifferences) { test::expectGradientsMatchDifferences(GetParam()); }
TEST_P(Noise, BoundsHold) { test::expectBoundsHold(GetParam()); }
TEST_P(Noise, BoundsConverge) { test::expectBoundsConverge(GetParam()); }
TEST_P(Noise, BatchesAgree) { test::expectBatchesAgree(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, Noise, testing::ValuesIn(noises()), testing::PrintToStringParamName());

TEST(Noise, OneOctaveFillsItsRangeAndNoMore) {
  const auto field = simplexNoise({.seed = 2, .octaves = 1});
  Random random(1);
  double lowest = 0, highest = 0, sum = 0;
  constexpr int kPoints = 1'000'000;
  for (int i = 0; i < kPoints; ++i) {
    const double v = field->valueAt(random.in(kRegion));
    lowest = std::min(lowest, v);
    highest = std::max(highest, v);
    sum += v;
  }
  EXPECT_GE(lowest, -1);
  EXPECT_LE(highest, 1);
  EXPECT_LT(lowest, -0.98);
  EXPECT_GT(highest, 0.98);
  EXPECT_NEAR(sum / kPoints, 0, 0.01);
}

// This holds only if neither the gradient nor, by and large, the second derivative jumps between simplices.
TEST(Noise, GradientsChangeNoFasterThanTheCurvatureAllows) {
  const auto field = simplexNoise({.octaves = 1});
  Random random(2);
  for (int i = 0; i < 100'000; ++i) {
    const Vec3d p = random.in(kRegion), step = random.in(Box{{-1e-3, -1e-3, -1e-3}, {1e-3, 1e-3, 1e-3}});
    ASSERT_LE(length(field->gradientAt(p + step) - field->gradientAt(p)), 49 * length(step) + 1e-12);
    ASSERT_LE(length(field->gradientAt(p)), 7);
  }
}

TEST(Noise, ValuesArePinned) {
  const struct {
    std::uint32_t seed;
    Vec3d p;
    double oneOctave, fourOctaves;
  } table[] = {
      {0, {0.5, 0.25, 0.125}, 0.086174213213900411, -0.24647137507605063},
      {0, {-3.3, 7.45, 1.8}, -0.52249530368278962, -0.42914367649192797},
      {0, {100.3, -50.7, 0.1}, 0.19874577833447801, 0.28976826246348192},
      {1, {0.5, 0.25, 0.125}, -0.1449518429067202, -0.69805356482021641},
      {1, {-3.3, 7.45, 1.8}, -0.45072468207375843, -0.58409535839744864},
      {1, {100.3, -50.7, 0.1}, 0.79179541157007716, 0.79195026728411277},
  };
  for (const auto& row : table) {
    EXPECT_EQ(simplexNoise({.seed = row.seed, .octaves = 1})->valueAt(row.p), row.oneOctave);
    EXPECT_EQ(simplexNoise({.seed = row.seed})->valueAt(row.p), row.fourOctaves);
  }
}

TEST(Noise, OctavesAddUp) {
  const NoiseOptions one{.seed = 4, .octaves = 1, .frequency = 0.7, .amplitude = 2};
  NoiseOptions two = one;
  two.octaves = 2;
  two.gain = 1e-9;
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random.in(kRegion);
    EXPECT_NEAR(simplexNoise(two)->valueAt(p), simplexNoise(one)->valueAt(p), 2e-9);
    const double unit = simplexNoise({.seed = 4, .octaves = 1})->valueAt(p * 0.7);
    EXPECT_DOUBLE_EQ(simplexNoise(one)->valueAt(p), 2 * unit);
  }
}

TEST(Noise, SeedsAreUnrelated) {
  Random random(4);
  const auto a = simplexNoise({.seed = 0, .octaves = 1}), b = simplexNoise({.seed = 1, .octaves = 1});
  double aa = 0, ab = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3d p = random.in(kRegion);
    aa += a->valueAt(p) * a->valueAt(p);
    ab += a->valueAt(p) * b->valueAt(p);
  }
  EXPECT_LT(std::abs(ab / aa), 0.05);
}

TEST(Noise, BoundsOfBigBoxesAreTheRange) {
  const auto field = simplexNoise({.octaves = 3, .gain = 0.5, .amplitude = 4});
  const Interval bound = field->bound(kRegion);
  EXPECT_NEAR(bound.lo, -7, 1e-8);
  EXPECT_NEAR(bound.hi, 7, 1e-8);
}

TEST(Noise, HasAValueEverywhere) {
  const auto field = simplexNoise({});
  for (const double far : {1e12, -1e12, 1e300, -1e300}) {
    EXPECT_EQ(field->valueAt({far, 0, 0}), 0);
    EXPECT_EQ(field->gradientAt({far, far, far}), (Vec3d{0, 0, 0}));
  }
  EXPECT_TRUE(std::isnan(field->valueAt({kNan, 0, 0})));
}

TEST(Noise, RefusesBadArguments) {
  EXPECT_THROW(simplexNoise({.octaves = 0}), std::invalid_argument);
  EXPECT_THROW(simplexNoise({.octaves = 17}), std::invalid_argument);
  for (const double bad : {0.0, -1.0, kNan, kInfinity}) {
    EXPECT_THROW(simplexNoise({.frequency = bad}), std::invalid_argument);
    EXPECT_THROW(simplexNoise({.gain = bad}), std::invalid_argument);
    EXPECT_THROW(simplexNoise({.lacunarity = bad}), std::invalid_argument);
  }
  EXPECT_THROW(simplexNoise({.amplitude = -1}), std::invalid_argument);
  EXPECT_THROW(simplexNoise({.amplitude = kNan}), std::invalid_argument);
  EXPECT_THROW(simplexNoise({.amplitude = kInfinity}), std::invalid_argument);
}

TEST(Noise, RefusesOctavesWhoseFrequencyOrAmplitudeLeavesTheRangeOfNumbers) {
  EXPECT_THROW(simplexNoise({.octaves = 16, .lacunarity = 1e30}), std::invalid_argument);
  EXPECT_THROW(simplexNoise({.octaves = 16, .lacunarity = 1e-30}), std::invalid_argument);
  EXPECT_THROW(simplexNoise({.octaves = 16, .gain = 1e30}), std::invalid_argument);
  EXPECT_NO_THROW(simplexNoise({.octaves = 16, .gain = 1e-30}));
}

}  // namespace
}  // namespace pdc
