#include "pdc/math/quadric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/quadric_checks.h"
#include "math/random_geometry.h"
#include "pdc/math/solvers.h"

namespace pdc {
namespace {

using Sym = SymMat3<double>;

TEST(Quadric, PlaneMeasuresSquaredDistance) {
  RandomGeometry random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d q = random.point(), n = random.direction(), x = random.point();
    EXPECT_NEAR(planeQuadric(q, n)(x), std::pow(dot(n, x - q), 2), 1e-13);
    EXPECT_NEAR(pointQuadric(q)(x), dot(x - q, x - q), 1e-13);
  }
}

TEST(Quadric, SumsMeasureSumsOfErrors) {
  RandomGeometry random(2);
  const auto p = planeQuadric(random.point(), random.direction()), q = pointQuadric(random.point());
  const Vec3d x = random.point();
  EXPECT_NEAR((p + q)(x), p(x) + q(x), 1e-13);
  EXPECT_NEAR((p * 3.0)(x), 3 * p(x), 1e-13);
  EXPECT_NEAR((p - q)(x), p(x) - q(x), 1e-13);
  auto f = p;
  f += q;
  EXPECT_EQ(f, p + q);
  f -= q;
  EXPECT_NEAR(f(x), p(x), 1e-13);
  f *= 2;
  EXPECT_NEAR(f(x), 2 * p(x), 1e-13);
  EXPECT_EQ(2.0 * p, p * 2.0);
}

TEST(Quadric, NormalEquationsAddLikeQuadrics) {
  RandomGeometry random(8);
  const auto p = planeQuadric(random.point(), random.direction()), q = pointQuadric(random.point());
  auto sum = NormalEquations<double>::zero();
  sum += p.normalEquations();
  sum += q.normalEquations();
  EXPECT_EQ(sum.A, (p + q).A);
  EXPECT_EQ(sum.b, (p + q).b);
}

TEST(Quadric, RelativeToAnotherOriginIsTheSameFunction) {
  RandomGeometry random(9);
  for (int i = 0; i < 1000; ++i) {
    const auto f = probabilisticPlaneQuadric(random.point(), random.direction(), 0.3);
    const Vec3d origin = random.point(), y = random.point();
    EXPECT_NEAR(f.relativeTo(origin)(y), f(y + origin), 1e-12 * (1 + f(y + origin)));
    const Mat3d M = random.matrix();
    EXPECT_NEAR(f.pullback(M, origin)(y), f(M * y + origin), 1e-11 * (1 + f(M * y + origin)));
  }
}

TEST(Quadric, PlanesMoveWithTheirPoints) {
  RandomGeometry random(10);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d q = random.point(), n = random.direction(), t = random.point(), x = random.point();
    const Sym Sigma_n = random.covariance(0.3), Sigma_q = random.covariance(0.3);
    const auto f = probabilisticPlaneQuadric(q, n, Sigma_n, Sigma_q);
    // Normals go by the inverse transpose.
    const Mat3d M = random.matrix(), K = inverse(M), N = K.transposed();
    const auto g =
        probabilisticPlaneQuadric(M * q + t, N * n, congruence(Sigma_n, K), congruence(Sigma_q, M.transposed()));
    EXPECT_NEAR(g(M * x + t), f(x), 1e-9 * (1 + f(x)) * (1 + g.A.trace()));
    EXPECT_NEAR(f.pullback(K, -(K * t))(M * x + t), f(x), 1e-9 * (1 + f(x)) * (1 + g.A.trace()));
  }
}

TEST(Quadric, PlanesScaleWithTheUnitOfLength) {
  RandomGeometry random(11);
  const Vec3d q = random.point(), n = random.direction();
  const double L = 0x1p10;
  const auto f = probabilisticPlaneQuadric(q, n, 0.1, 0.2), g = probabilisticPlaneQuadric(q * L, n, 0.1, 0.2 * L);
  EXPECT_EQ(g.A, f.A);
  EXPECT_EQ(g.b, f.b * L);
  EXPECT_EQ(g.c, f.c * (L * L));
}

TEST(Quadric, HalfGradientIsHalfTheSlope) {
  RandomGeometry random(3);
  const auto q = planeQuadric(random.point(), random.direction()) + pointQuadric(random.point());
  const Vec3d x = random.point(), d = random.direction();
  const double h = 1e-5;
  EXPECT_NEAR(dot(q.halfGradient(x), d), (q(x + d * h) - q(x - d * h)) / (4 * h), 1e-8);
}

TEST(Quadric, WithoutNoiseTheProbabilisticPlaneIsTheClassicalOne) {
  RandomGeometry random(4);
  const Vec3d q = random.point(), n = random.direction();
  const auto a = probabilisticPlaneQuadric(q, n, 0.0), b = planeQuadric(q, n);
  EXPECT_EQ(a, b);
  EXPECT_EQ(probabilisticPlaneQuadric(q, n, Sym::zero(), Sym::zero()), b);
}

TEST(Quadric, TheProbabilisticPlaneIsTheExpectedPlane) {
  RandomGeometry random(5);
  const Vec3d q{0.3, -0.2, 0.5}, n{0.6, 0, 0.8};
  const Mat3d N = random.covarianceRoot(0.2), Q = random.covarianceRoot(0.2);
  const auto sampled =
      sampleExpectedQuadric(1'000'000, [&] { return planeQuadric(q + Q * random.point(), n + N * random.point()); });
  expectIsTheMean(sampled, probabilisticPlaneQuadric(q, n, random.covarianceOf(N), random.covarianceOf(Q)), 2e-3);
}

TEST(Quadric, TheIsotropicPlaneIsTheExpectedPlane) {
  RandomGeometry random(12);
  const Vec3d q{0.3, -0.2, 0.5}, n{0.6, 0, 0.8};
  const double sigmaNormal = 0.2, sigmaPosition = 0.3;
  const auto sampled = sampleExpectedQuadric(
      1'000'000, [&] { return planeQuadric(q + random.point() * sigmaPosition, n + random.point() * sigmaNormal); });
  const auto expected = probabilisticPlaneQuadric(q, n, sigmaNormal, sigmaPosition);
  expectIsTheMean(sampled, expected, 2e-3);
  const auto full = probabilisticPlaneQuadric(q, n, Sym::identity() * 0.04, Sym::identity() * 0.09);
  EXPECT_LT(largestDifference(full, expected), 1e-15);
}

TEST(Quadric, NoiseOfNormalsAddsTheSameToASumOfPlanes) {
  RandomGeometry random(21);
  const Sym Sigma_n = outer(random.point()) + outer(random.point());
  auto planes = Quadric<double>::zero(), probabilistic = Quadric<double>::zero();
  Vec3d points{};
  double weight = 0, squares = 0;
  for (int i = 0; i < 7; ++i) {
    const Vec3d p = random.point(), n = random.direction();
    const double w = 0.5 + i;
    planes += planeQuadric(p, n) * w;
    probabilistic += probabilisticPlaneQuadric(p, n, Sigma_n) * w;
    points += p * w;
    weight += w;
    squares += w * quadraticForm(Sigma_n, p);
  }
  const auto sum = planes + normalNoiseQuadric(Sigma_n, weight, points, squares);
  for (int i = 0; i < 20; ++i) {
    const Vec3d x = random.point();
    EXPECT_NEAR(sum(x), probabilistic(x), 1e-12 * probabilistic(x));
  }
}

TEST(Quadric, TheTangentialPlaneIsTheExpectedPlane) {
  RandomGeometry random(13);
  const Vec3d q{0.3, -0.2, 0.5}, n{0.6, 0, 0.8};
  const double sigma = 0.2;
  const auto sampled = sampleExpectedQuadric(1'000'000, [&] {
    const Vec3d d = random.point() * sigma;
    return planeQuadric(q, n + (d - n * dot(n, d)));
  });
  const auto expected = probabilisticPlaneQuadric(q, n, tangentialCovariance(n, sigma));
  expectIsTheMean(sampled, expected, 2e-3);
  EXPECT_NEAR(quadraticForm(expected.A, n), 1, 1e-15) << "nothing is added along the normal";
  EXPECT_TRUE(solveLdlt(expected.A, expected.b));
}

TEST(Quadric, NoiseOfThePositionsMovesNoMinimiser) {
  RandomGeometry random(14);
  for (int i = 0; i < 100; ++i) {
    const Vec3d q = random.point(), n = random.direction();
    const Sym Sigma_n = random.covariance(0.2), Sigma_q = random.covariance(1);
    const auto f = probabilisticPlaneQuadric(q, n, Sigma_n), g = probabilisticPlaneQuadric(q, n, Sigma_n, Sigma_q);
    EXPECT_EQ(f.A, g.A);
    EXPECT_EQ(f.b, g.b);
    const auto iso = probabilisticPlaneQuadric(q, n, 0.2), noisy = probabilisticPlaneQuadric(q, n, 0.2, 1.0);
    EXPECT_EQ(iso.A, noisy.A);
    EXPECT_EQ(iso.b, noisy.b);
    EXPECT_NEAR(noisy.c - iso.c, 1 + 3 * 0.2 * 0.2, 1e-12 * (1 + noisy.c));
    // The floor of the constant: what is left at q itself.
    EXPECT_NEAR(g(q), quadraticForm(Sigma_q, n) + traceOfProduct(Sigma_n, Sigma_q), 1e-12 * (1 + g.c));
  }
}

TEST(Quadric, TheMinimiserBeatsRandomPoints) {
  RandomGeometry random(6);
  auto q = Quadric<double>::zero();
  for (int i = 0; i < 5; ++i) q += probabilisticPlaneQuadric(random.point(), random.direction(), 0.1);
  const auto x = solveLdlt(q.A, q.b);
  ASSERT_TRUE(x);
  for (int i = 0; i < 10'000; ++i) EXPECT_LT(q(*x), q(*x + random.point()));
}

TEST(Quadric, LargeNoiseLeavesTheCentreOfTheSamples) {
  RandomGeometry random(7);
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
