#include "pdc/math/quadric.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "pdc/math/solvers.h"

namespace pdc {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : mEngine(seed) {}
  Vec3d point() { return {mNormal(mEngine), mNormal(mEngine), mNormal(mEngine)}; }
  Vec3d direction() {
    const Vec3d v = point();
    return v * (1 / length(v));
  }

 private:
  std::mt19937_64 mEngine;
  std::normal_distribution<double> mNormal;
};

TEST(Quadric, PlaneMeasuresSquaredDistance) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d q = random.point(), n = random.direction(), x = random.point();
    EXPECT_NEAR(planeQuadric(q, n)(x), std::pow(dot(n, x - q), 2), 1e-13);
    EXPECT_NEAR(pointQuadric(q)(x), dot(x - q, x - q), 1e-13);
  }
}

TEST(Quadric, SumsMeasureSumsOfErrors) {
  Random random(2);
  const auto p = planeQuadric(random.point(), random.direction()), q = pointQuadric(random.point());
  const Vec3d x = random.point();
  EXPECT_NEAR((p + q)(x), p(x) + q(x), 1e-13);
  EXPECT_NEAR((p * 3.0)(x), 3 * p(x), 1e-13);
}

TEST(Quadric, HalfGradientIsHalfTheSlope) {
  Random random(3);
  const auto q = planeQuadric(random.point(), random.direction()) + pointQuadric(random.point());
  const Vec3d x = random.point(), d = random.direction();
  const double h = 1e-5;
  EXPECT_NEAR(dot(q.halfGradient(x), d), (q(x + d * h) - q(x - d * h)) / (4 * h), 1e-8);
}

TEST(Quadric, WithoutNoiseTheProbabilisticPlaneIsTheClassicalOne) {
  Random random(4);
  const Vec3d q = random.point(), n = random.direction();
  const auto a = probabilisticPlaneQuadric(q, n, 0.0), b = planeQuadric(q, n);
  EXPECT_EQ(a.A, b.A);
  EXPECT_EQ(a.b, b.b);
  EXPECT_EQ(a.c, b.c);
}

TEST(Quadric, TheProbabilisticPlaneIsTheExpectedPlane) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  const Vec3d q{0.3, -0.2, 0.5}, n{0.6, 0, 0.8};
  // Σn = LLᵀ with L lower triangular.
  const Mat3d L{{Vec3d{0.3, 0, 0}, Vec3d{0.1, 0.2, 0}, Vec3d{-0.05, 0.07, 0.15}}};
  const Mat3d S = L * L.transposed();
  const SymMat3<double> Sigma_n{S.row[0].x, S.row[0].y, S.row[0].z, S.row[1].y, S.row[1].z, S.row[2].z};
  constexpr int kSamples = 2'000'000;
  auto mean = Quadric<double>::zero();
  for (int i = 0; i < kSamples; ++i)
    mean += planeQuadric(q, n + L * Vec3d{normal(engine), normal(engine), normal(engine)});
  mean = mean * (1.0 / kSamples);
  const auto expected = probabilisticPlaneQuadric(q, n, Sigma_n);
  constexpr double kTolerance = 2e-3;  // About five standard errors.
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(mean.A(i, j), expected.A(i, j), kTolerance);
    EXPECT_NEAR(mean.b[i], expected.b[i], kTolerance);
  }
  EXPECT_NEAR(mean.c, expected.c, kTolerance);
}

TEST(Quadric, TheMinimiserBeatsRandomPoints) {
  Random random(6);
  auto q = Quadric<double>::zero();
  for (int i = 0; i < 5; ++i) q += probabilisticPlaneQuadric(random.point(), random.direction(), 0.1);
  const auto x = solveLdlt(q.A, q.b);
  ASSERT_TRUE(x);
  for (int i = 0; i < 10'000; ++i) EXPECT_LT(q(*x), q(*x + random.point()));
}

TEST(Quadric, LargeNoiseLeavesTheCentreOfTheSamples) {
  Random random(7);
  auto q = Quadric<double>::zero();
  Vec3d centre{};
  for (int i = 0; i < 6; ++i) {
    const Vec3d p = random.point();
    centre += p * (1.0 / 6);
    q += probabilisticPlaneQuadric(p, random.direction(), 1e6);
  }
  const auto x = solveLdlt(q.A, q.b);
  ASSERT_TRUE(x);
  EXPECT_LT(length(*x - centre), 1e-10);
}

}  // namespace
}  // namespace pdc
