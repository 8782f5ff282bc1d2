#include "sample/creases/smooth_sheets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>

namespace pdc::detail {
namespace {

/// Samples of a surface near the origin, with noise.
struct Cloud {
  /// \param sample makes a foot point and a normal of two numbers from -1 to 1.
  Cloud(double noise, const std::function<void(double, double, Vec3d&, Vec3d&)>& sample)
      : normalNoise(kNormalNoise * noise) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> place(-1, 1);
    std::normal_distribution<double> random;
    samples.count = 96;
    for (int i = 0; i < samples.count; ++i) {
      Vec3d foot, n;
      sample(place(engine), place(engine), foot, n);
      foot += n * (noise * random(engine));
      for (int k = 0; k < 3; ++k) n[k] += normalNoise * random(engine);
      n *= 1 / length(n);
      for (int k = 0; k < 3; ++k) {
        samples.column[SurfaceSamples::kNormalX + k][i] = static_cast<float>(n[k]);
        samples.column[SurfaceSamples::kFootX + k][i] = static_cast<float>(foot[k]);
      }
      samples.column[SurfaceSamples::kSupport][i] = samples.column[SurfaceSamples::kFitWeight][i] = 1;
    }
    for (int i = samples.count; i < samples.blocks() * kLanes; ++i)
      for (auto& column : samples.column) column[i] = 0;
    sheets = findSheets(samples, normalNoise, *weights);
    found = sheets.count;
    joinSmoothSheets(samples, normalNoise, sheets, *weights);
  }
  double normalNoise;
  SurfaceSamples samples{};
  std::unique_ptr<SheetWeights> weights = std::make_unique<SheetWeights>();
  CreaseSheets sheets;
  int found;  ///< Sheets before any were joined.
};

/// The ridge of a roof whose sides lean by an angle in radians.
auto roof(double lean) {
  return [lean](double u, double v, Vec3d& foot, Vec3d& n) {
    const double side = u < 0 ? -1 : 1;
    foot = {u * std::cos(lean), v, -std::abs(u) * std::sin(lean)};
    n = {side * std::sin(lean), 0, std::cos(lean)};
  };
}

auto ball(double radius) {
  return [radius](double u, double v, Vec3d& foot, Vec3d& n) {
    const double a = u * 1.2 / radius, b = v * 1.2 / radius;
    n = {std::sin(a), std::cos(a) * std::sin(b), std::cos(a) * std::cos(b)};
    foot = n * radius - Vec3d{0, 0, radius};
  };
}

TEST(SmoothSheets, TheSidesOfACreaseStayApart) {
  for (const double lean : {0.3, 0.6, 1.0}) EXPECT_EQ(Cloud(0, roof(lean)).sheets.count, 2) << lean;
  for (const double lean : {0.6, 1.0}) EXPECT_EQ(Cloud(0.02, roof(lean)).sheets.count, 2) << lean;
  EXPECT_EQ(Cloud(0.05, roof(0.8)).sheets.count, 2);
}

TEST(SmoothSheets, ASmallSphereIsOne) {
  for (const double radius : {1.5, 2.0, 4.0}) {
    const Cloud cloud(0, ball(radius));
    EXPECT_EQ(cloud.sheets.count, 1) << radius;
    EXPECT_GE(cloud.found, radius < 3 ? 2 : 1) << radius;
    EXPECT_NEAR(cloud.sheets.sheet[0].traceOfBend(), 2 / radius, 0.3 * 2 / radius) << radius;
  }
}

TEST(SmoothSheets, NoisePartsNoPlane) {
  const Cloud cloud(0.1, roof(0));
  EXPECT_GE(cloud.found, 2);
  EXPECT_EQ(cloud.sheets.count, 1);
  EXPECT_GT(cloud.sheets.sheet[0].normal.z, std::cos(0.1));
  EXPECT_NEAR(cloud.sheets.sheet[0].value({}), 0, 0.05);
}

TEST(SmoothSheets, TheSidesOfSomethingThinStayApart) {
  const Cloud cloud(0, [](double u, double v, Vec3d& foot, Vec3d& n) {
    const double side = u * v < 0 ? -1 : 1;
    foot = {u, v, side * 0.4};
    n = {0, 0, side};
  });
  EXPECT_EQ(cloud.sheets.count, 2);
}

TEST(SmoothSheets, DoNotDependOnTheProcessor) {
  const Cloud cloud(0.1, ball(3));
  SurfaceSamples again = Cloud(0.1, ball(3)).samples;
  std::fill_n(again.column[SurfaceSamples::kSupport].begin(), again.count, 1.0F);
  std::fill_n(again.column[SurfaceSamples::kFitWeight].begin(), again.count, 1.0F);
  const auto weights = std::make_unique<SheetWeights>();
  CreaseSheets sheets = findSheets(again, cloud.normalNoise, *weights, SimdLevel::kBaseline);
  joinSmoothSheets(again, cloud.normalNoise, sheets, *weights, SimdLevel::kBaseline);
  ASSERT_EQ(sheets.count, cloud.sheets.count);
  for (int i = 0; i < sheets.count; ++i) {
    EXPECT_EQ(sheets.sheet[i].normal, cloud.sheets.sheet[i].normal);
    EXPECT_EQ(sheets.sheet[i].offset, cloud.sheets.sheet[i].offset);
  }
}

}  // namespace
}  // namespace pdc::detail
