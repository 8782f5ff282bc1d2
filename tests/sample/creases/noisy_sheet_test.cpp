#include "sample/creases/noisy_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "simd_levels.h"

namespace pdc::detail {
namespace {

/// Samples of a paraboloid w = ½ bend (u² + v²) over the plane through the origin with some normal, with noise.
struct Paraboloid {
  Paraboloid(double bend, double noise, unsigned seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> random(0, 1);
    std::uniform_real_distribution<double> place(-1, 1);
    samples.count = 80;
    for (int i = 0; i < samples.count; ++i) {
      const double u = place(engine), v = place(engine), w = 0.5 * bend * (u * u + v * v) + noise * random(engine);
      const Vec3d foot = e1 * u + e2 * v + n * w;
      Vec3d normal = n - e1 * (bend * u) - e2 * (bend * v);
      for (int k = 0; k < 3; ++k) normal[k] += kNormalNoise * noise * random(engine);
      normal *= 1 / length(normal);
      for (int k = 0; k < 3; ++k) {
        samples.column[SurfaceSamples::kNormalX + k][i] = static_cast<float>(normal[k]);
        samples.column[SurfaceSamples::kFootX + k][i] = static_cast<float>(foot[k]);
      }
      fitWeight[i] = 1;
    }
    for (int i = samples.count; i < samples.blocks() * kLanes; ++i) {
      for (auto& column : samples.column) column[i] = 0;
      fitWeight[i] = 0;
    }
  }
  Vec3d n{2.0 / 3, -1.0 / 3, 2.0 / 3}, e1{1 / std::sqrt(2.0), 0, -1 / std::sqrt(2.0)}, e2 = cross(n, e1);
  SurfaceSamples samples{};
  std::array<float, SurfaceSamples::kCapacity> fitWeight{};
};

CreaseSheet tilted(const Paraboloid& p, double slope) {
  Vec3d normal = p.n + p.e1 * slope;
  normal *= 1 / length(normal);
  return {.center = {0.1, 0.05, -0.1}, .normal = normal, .bend = {}, .offset = 0, .support = 80, .moments = {}};
}

TEST(NoisySheet, FindsAPlaneFromATiltedStart) {
  const Paraboloid p(0, 0, 1);
  const CreaseSheet sheet = fitNoisySheet(p.samples, p.fitWeight.data(), tilted(p, 0.02), 0.01).sheet;
  EXPECT_GT(dot(sheet.normal, p.n), 1 - 1e-8);
  EXPECT_NEAR(sheet.value({}), 0, 1e-5);
}

TEST(NoisySheet, LeansFarBetterThanTheMeanNormalOfNoisySamples) {
  constexpr double kNoise = 0.05;
  double fitted = 0, mean = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Paraboloid p(0, kNoise, seed);
    Vec3d normal{};
    for (int i = 0; i < p.samples.count; ++i) normal += vecCast<double>(p.samples.normal(i));
    normal *= 1 / length(normal);
    const CreaseSheet start{{}, normal, {}, 0, 80};
    const CreaseSheet sheet = fitNoisySheet(p.samples, p.fitWeight.data(), start, kNormalNoise * kNoise).sheet;
    fitted += length(sheet.normal - p.n);
    mean += length(normal - p.n);
  }
  EXPECT_LT(fitted, 0.6 * mean);
}

TEST(NoisySheet, KeepsABendThatManySamplesShow) {
  const Paraboloid p(0.05, 0.001, 3);
  const CreaseSheet sheet = fitNoisySheet(p.samples, p.fitWeight.data(), tilted(p, 0), kNormalNoise * 0.001).sheet;
  EXPECT_NEAR(dot(p.e1, sheet.bend * p.e1), -0.05, 0.01);
  EXPECT_NEAR(dot(p.e2, sheet.bend * p.e2), -0.05, 0.01);
  EXPECT_NEAR(dot(sheet.normal, sheet.bend * sheet.normal), 0, 1e-4);
}

TEST(NoisySheet, SimdLevelsAgree) {
  const Paraboloid p(0.02, 0.02, 5);
  const auto fit = [&](SimdLevel level) {
    return fitNoisySheet(p.samples, p.fitWeight.data(), tilted(p, 0.02), 0.08, level).sheet;
  };
  if (test::wideSimdLevels().empty()) GTEST_SKIP() << "this processor has one level only";
  const CreaseSheet base = fit(SimdLevel::kBaseline);
  for (const SimdLevel level : test::wideSimdLevels()) {
    EXPECT_EQ(fit(level).normal, base.normal);
    EXPECT_EQ(fit(level).offset, base.offset);
  }
}

}  // namespace
}  // namespace pdc::detail
