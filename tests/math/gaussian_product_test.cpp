#include "pdc/math/gaussian_product.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <random>

#include "pdc/math/quadric_interpolation.h"

namespace pdc {
namespace {

/// Gaussians and planes with any of what the formulas take.
class RandomCases {
 public:
  double normal() { return mNormal(mRandom); }
  double between(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(mRandom); }
  Vec3d point() { return {normal(), normal(), normal()}; }
  Vec3d direction() {
    const Vec3d v = point();
    return v * (1 / length(v));
  }
  /// Eigenvalues are `least` and more.
  SymMat3<double> covariance(double least) {
    return (outer(point()) + outer(point()) + outer(point())).plusDiagonal(least);
  }

 private:
  std::mt19937 mRandom{5};
  std::normal_distribution<double> mNormal;
};

Eigen::Matrix3d full(const SymMat3<double>& m) {
  Eigen::Matrix3d result;
  result << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return result;
}

TEST(Gaussian, KeepsItsCovariance) {
  RandomCases random;
  for (int i = 0; i < 100; ++i) {
    const SymMat3<double> covariance = random.covariance(0.1);
    const Gaussian g = Gaussian::fromCovariance(random.point(), covariance).value();
    EXPECT_LT((full(g.precision) - full(covariance).inverse()).norm(), 1e-12 * full(g.precision).norm());
    EXPECT_LT((full(g.covariance()) - full(covariance)).norm(), 1e-12 * full(covariance).norm());
  }
  EXPECT_FALSE(Gaussian::fromCovariance({0, 0, 0}, {1, 0, 0, 1, 0, 0}));
  EXPECT_FALSE(Gaussian::fromCovariance({0, 0, 0}, {1, 2, 0, 1, 0, 1}));
}

TEST(Gaussian, ComesBackFromTheDualSpace) {
  RandomCases random;
  const Gaussian g = Gaussian::fromCovariance(random.point(), random.covariance(0.1)).value();
  const Gaussian back = fromDual(dualOf(g)).value();
  EXPECT_LT(length(back.mean - g.mean), 1e-13);
  EXPECT_EQ(back.precision, g.precision);
  EXPECT_FALSE(fromDual(NormalEquations<double>::zero()));
}

/// Equations 6 and 13: the exponents of the densities add up.
TEST(GaussianProduct, IsTheProductOfTheDensities) {
  RandomCases random;
  const std::array gaussians{Gaussian::fromCovariance(random.point(), random.covariance(0.1)).value(),
                             Gaussian::fromCovariance(random.point(), random.covariance(0.1)).value(),
                             Gaussian::fromCovariance(random.point(), random.covariance(0.1)).value()};
  const std::array weights{0.5, 0.2, 1.3};
  const Gaussian all = product(gaussians, weights);
  const auto exponent = [](const Gaussian& g, const Vec3d& x) { return quadraticForm(g.precision, x - g.mean); };
  double constant = 0;
  for (int i = 0; i < 20; ++i) {
    const Vec3d x = random.point();
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += weights[k] * exponent(gaussians[k], x);
    if (i == 0) constant = sum - exponent(all, x);
    EXPECT_NEAR(sum - exponent(all, x), constant, 1e-11 * sum);
  }
}

TEST(GaussianProduct, IsASumInTheDualSpace) {
  RandomCases random;
  for (int i = 0; i < 100; ++i) {
    const std::array gaussians{Gaussian::fromCovariance(random.point(), random.covariance(0.1)).value(),
                               Gaussian::fromCovariance(random.point(), random.covariance(0.1)).value()};
    const double t = random.between(0, 1);
    NormalEquations<double> sum{dualOf(gaussians[0]).A * t, dualOf(gaussians[0]).b * t};
    sum += {dualOf(gaussians[1]).A * (1 - t), dualOf(gaussians[1]).b * (1 - t)};
    EXPECT_LT(length(fromDual(sum).value().mean - product(gaussians, std::array{t, 1 - t}).mean), 1e-12);
  }
}

/// Equation 5 with its ends, its end tangent Σa Σb⁻¹ (b − a), and the straight line of isotropic Gaussians.
TEST(GaussianCurve, LeavesItsEndsAsItShould) {
  RandomCases random;
  const SymMat3<double> covarianceA = random.covariance(0.2), covarianceB = random.covariance(0.2);
  const Gaussian a = Gaussian::fromCovariance(random.point(), covarianceA).value();
  const Gaussian b = Gaussian::fromCovariance(random.point(), covarianceB).value();
  EXPECT_LT(length(gaussianCurve(a, b, 0).mean - a.mean), 1e-14);
  EXPECT_LT(length(gaussianCurve(a, b, 1).mean - b.mean), 1e-13);
  constexpr double kStep = 1e-7;
  const Vec3d tangent = (gaussianCurve(a, b, kStep).mean - a.mean) * (1 / kStep);
  const Vec3d expected = covarianceA * (b.precision * (b.mean - a.mean));
  EXPECT_LT(length(tangent - expected), 1e-5 * length(expected));
  const Gaussian round{a.mean, SymMat3<double>::identity()}, rounder{b.mean, SymMat3<double>::identity() * 5.0};
  for (const double t : {0.1, 0.5, 0.9}) {
    const Vec3d p = gaussianCurve(round, rounder, t).mean - a.mean;
    EXPECT_LT(length(cross(p, b.mean - a.mean)), 1e-14);
  }
}

/// Figure 6a: less anisotropy makes a straighter curve.
TEST(GaussianCurve, StraightensWithLessAnisotropy) {
  double before = 1;
  for (const double tangential : {1.0, 0.5, 0.2, 0.1, 0.05, 0.01}) {
    const Gaussian a = Gaussian::fromCovariance({-1, 0, 0}, {0.01, 0, 0, tangential, 0, 0.01}).value();
    const Gaussian b = Gaussian::fromCovariance({0, 1, 0}, {tangential, 0, 0, 0.01, 0, 0.01}).value();
    double farthest = 0;
    for (int i = 0; i <= 100; ++i) {
      const Vec3d p = gaussianCurve(a, b, i / 100.0).mean;
      farthest = std::max(farthest, std::abs(p.y - p.x - 1) / std::sqrt(2));
    }
    EXPECT_LT(farthest, before);
    before = farthest;
  }
  EXPECT_LT(before, 1e-14);
}

/// Flat covariances far from the origin lose nothing; the dual space loses eight digits.
TEST(GaussianSum, KeepsItsDigitsFarAway) {
  const Vec3d far{1e6, -3e6, 2e6};
  const SymMat3<double> flat = outer(Vec3d{1, 2, 2} * (1.0 / 3)) * -0.99999;
  const Gaussian a = Gaussian::fromCovariance({0.5, 0, 0}, flat.plusDiagonal(1)).value();
  const Gaussian b = Gaussian::fromCovariance({0, 0.25, 0}, SymMat3<double>{1, 0, 0, 1e-5, 0, 1}).value();
  const Vec3d near = gaussianCurve(a, b, 0.25).mean;
  const Gaussian movedA{a.mean + far, a.precision}, movedB{b.mean + far, b.precision};
  EXPECT_LT(length(gaussianCurve(movedA, movedB, 0.25).mean - far - near), 1e-9);
  const NormalEquations<double> p = dualOf(movedA), q = dualOf(movedB);
  const Vec3d lost = fromDual({p.A * 0.75 + q.A * 0.25, p.b * 0.75 + q.b * 0.25}).value().mean - far - near;
  EXPECT_GT(length(lost), 1e-7) << "or this test shows nothing";
}

TEST(QuadricInterpolation, IsGaussianProductInterpolation) {
  RandomCases random;
  double largest = 0;
  for (int i = 0; i < 10000; ++i) {
    std::array<Quadric<double>, 4> quadrics;
    std::array<Gaussian, 4> gaussians;
    std::array<double, 4> weights;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3d q = random.point(), n = random.direction();
      const SymMat3<double> Sigma_n = random.covariance(0.05);
      quadrics[k] = probabilisticPlaneQuadric(q, n, Sigma_n);
      const SymMat3<double> covariance = inversePositive(outer(n) + Sigma_n).value();
      gaussians[k] = Gaussian::fromCovariance(q, covariance).value();
      weights[k] = random.between(0, 1);
    }
    const Vec3d x = interpolate(quadrics, weights).value();
    largest = std::max(largest, length(x - product(gaussians, weights).mean) / (1 + length(x)));
  }
  EXPECT_LT(largest, 1e-12);
}

TEST(QuadricInterpolation, PatchesMeetTheirCorners) {
  RandomCases random;
  std::array<Quadric<double>, 4> corners;
  std::array<Vec3d, 4> q;
  for (std::size_t k = 0; k < 4; ++k) {
    q[k] = random.point();
    corners[k] = probabilisticPlaneQuadric(q[k], random.direction(), 0.1);
  }
  const std::array uv{std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}};
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_LT(length(interpolateBilinear(corners, uv[k].first, uv[k].second).value() - q[k]), 1e-12);
  const std::array<Quadric<double>, 3> three{corners[0], corners[1], corners[2]};
  EXPECT_LT(length(interpolateBarycentric(three, {0, 1, 0}).value() - q[1]), 1e-12);
  EXPECT_LT(length(interpolateCurve({corners[0], corners[1]}, 1).value() - q[1]), 1e-12);
  const Vec3d edge = interpolateBilinear(corners, 0.3, 0).value();
  EXPECT_LT(length(edge - interpolateCurve({corners[0], corners[1]}, 0.3).value()), 1e-13);
  EXPECT_LT(length(edge - interpolateBarycentric(three, {0.7, 0.3, 0}).value()), 1e-13);
}

TEST(QuadricInterpolation, EqualNormalsAreLinear) {
  RandomCases random;
  const Vec3d n = random.direction();
  std::array<Quadric<double>, 4> corners;
  std::array<Vec3d, 4> q;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = probabilisticPlaneQuadric(q[k] = random.point(), n, 0.05);
  const Vec3d expected = q[0] * 0.42 + q[1] * 0.28 + q[2] * 0.12 + q[3] * 0.18;
  EXPECT_LT(length(interpolateBilinear(corners, 0.4, 0.3).value() - expected), 1e-11);
}

/// With σn high it is the linear interpolation; with σn low a point lies on all planes that it counts.
TEST(QuadricInterpolation, HasTheRightLimits) {
  RandomCases random;
  std::array<Vec3d, 3> q, n;
  for (std::size_t k = 0; k < 3; ++k) {
    q[k] = random.point();
    n[k] = random.direction();
  }
  const auto at = [&](double sigma) {
    const std::array<Quadric<double>, 3> corners{probabilisticPlaneQuadric(q[0], n[0], sigma),
                                                 probabilisticPlaneQuadric(q[1], n[1], sigma),
                                                 probabilisticPlaneQuadric(q[2], n[2], sigma)};
    return interpolateBarycentric(corners, {0.2, 0.3, 0.5}).value();
  };
  EXPECT_LT(length(at(1e5) - (q[0] * 0.2 + q[1] * 0.3 + q[2] * 0.5)), 1e-9);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(std::abs(dot(n[k], at(1e-5) - q[k])), 1e-8);
  EXPECT_FALSE(interpolate(std::array{planeQuadric(q[0], n[0])}, std::array{1.0}));
}

}  // namespace
}  // namespace pdc
