#include "pdc/math/solve_quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/random_geometry.h"
#include "pdc/math/expected_quadric.h"
#include "pdc/math/solvers.h"

namespace pdc {
namespace {

TEST(SolveQuality, CountsAndComparesEigenvalues) {
  RandomGeometry random(1);
  for (int i = 0; i < 100; ++i) {
    const auto A = congruence(SymMat3<double>{4, 0, 0, 0.5, 0, 0.001}, random.rotation());
    const SolveQuality quality = solveQuality(A, 0.01);
    EXPECT_NEAR(quality.condition, 4000, 1e-8);
    EXPECT_EQ(quality.rank, 2);
    EXPECT_EQ(solveQuality(A, 1e-6).rank, 3);
  }
  EXPECT_EQ(solveQuality(outer(Vec3d{1, 0, 0}), 1e-6).rank, 1);
  EXPECT_TRUE(std::isinf(solveQuality(outer(Vec3d{1, 0, 0}), 1e-6).condition));
  EXPECT_EQ(solveQuality(SymMat3<double>::zero(), 0).rank, 0);
  EXPECT_TRUE(std::isinf(solveQuality(SymMat3<double>::zero(), 0).condition));
}

// Planes with noisy offsets, solved again and again: the minimisers scatter as predicted.
TEST(SolutionCovariance, IsTheScatterOfTheMinimisers) {
  RandomGeometry random(2);
  constexpr int kPlanes = 6;
  const double sigma = 0.1;
  Vec3d n[kPlanes];
  auto A = SymMat3<double>::zero();
  for (Vec3d& v : n) A += outer(v = random.direction());
  const auto expected = solutionCovariance(A, sigma * sigma);
  ASSERT_TRUE(expected);
  double residuals = 0;
  const auto sampled = sampleExpectedQuadric(100'000, [&] {
    auto f = Quadric<double>::zero();
    for (const Vec3d& v : n) f += planeQuadric(v * (sigma * random.normal()), v);
    const auto x = solveLdlt(f.A, f.b);
    residuals += f(*x);
    return Quadric<double>{outer(*x), *x, 0};
  });
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(sampled.mean.b[i], 0, 5 * sampled.standardError.b[i]);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(sampled.mean.A(i, j), (*expected)(i, j), 5 * sampled.standardError.A(i, j));
  }
  EXPECT_NEAR(residuals / 100'000 / (kPlanes - 3), sigma * sigma, 2e-4);
  EXPECT_FALSE(solutionCovariance(outer(n[0]), 1));
}

}  // namespace
}  // namespace pdc
