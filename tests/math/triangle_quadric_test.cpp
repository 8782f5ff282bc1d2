#include "pdc/math/triangle_quadric.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "math/global_frame_quadric.h"
#include "math/quadric_checks.h"
#include "math/random_geometry.h"
#include "pdc/math/solvers.h"

namespace pdc {
namespace {

using Sym = SymMat3<double>;

/// A triangle with uncertain corners.
struct Triangle {
  std::array<Vec3d, 3> corner;
  std::array<Sym, 3> Sigma;

  static Triangle random(RandomGeometry& random) {
    return {{random.point(), random.point(), random.point()},
            {random.covariance(0.2), random.covariance(0.2), random.covariance(0.2)}};
  }
  [[nodiscard]] Triangle moved(const Mat3d& M, const Vec3d& t) const {
    Triangle m = *this;
    for (Vec3d& x : m.corner) x = M * x + t;
    for (Sym& s : m.Sigma) s = congruence(s, M.transposed());
    return m;
  }
  [[nodiscard]] Quadric<double> quadric(int first = 0) const {
    const int a = first, b = (first + 1) % 3, c = (first + 2) % 3;
    return probabilisticTriangleQuadric(corner[a], corner[b], corner[c], Sigma[a], Sigma[b], Sigma[c]);
  }
  [[nodiscard]] Quadric<double> classical() const { return triangleQuadric(corner[0], corner[1], corner[2]); }
};

TEST(TriangleQuadric, MeasuresDistanceTimesTwiceTheArea) {
  RandomGeometry random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random.point(), q = random.point(), r = random.point(), x = random.point();
    const double sixVolumes = dot(cross(q - p, r - p), x - p);
    EXPECT_NEAR(triangleQuadric(p, q, r)(x), sixVolumes * sixVolumes, 1e-11 * (1 + sixVolumes * sixVolumes));
  }
}

TEST(CrossInterference, IsTheExpectedCrossProductSquare) {
  RandomGeometry random(2);
  const Mat3d a = random.covarianceRoot(1), b = random.covarianceRoot(1);
  const auto sampled = sampleExpectedQuadric(1'000'000, [&] {
    return Quadric<double>{outer(cross(a * random.point(), b * random.point())), Vec3d{}, 0};
  });
  const auto Ci = crossInterference(random.covarianceOf(a), random.covarianceOf(b));
  expectIsTheMean(sampled, {Ci, Vec3d{}, 0}, 3e-3);
}

TEST(CrossInterference, IsSymmetricInItsArgumentsAndTwoForIdentities) {
  RandomGeometry random(3);
  EXPECT_EQ(crossInterference(Sym::identity(), Sym::identity()), Sym::identity() * 2.0);
  for (int i = 0; i < 100; ++i) {
    const Sym A = random.covariance(1), B = random.covariance(1), C = random.covariance(1);
    const Quadric<double> AB{crossInterference(A, B), {}, 0}, BA{crossInterference(B, A), {}, 0};
    EXPECT_LT(largestDifference(AB, BA), 1e-14 * A.trace() * B.trace());
    const double t = traceOfProduct(C, crossInterference(A, B));
    EXPECT_NEAR(traceOfProduct(A, crossInterference(B, C)), t, 1e-12 * t);
    EXPECT_NEAR(traceOfProduct(B, crossInterference(C, A)), t, 1e-12 * t);
  }
}

TEST(CrossInterference, WithAnEdgeIsTheFirstOrderTerm) {
  RandomGeometry random(4);
  for (int i = 0; i < 100; ++i) {
    const Vec3d e = random.point(), x = random.point();
    const Sym S = random.covariance(1);
    EXPECT_NEAR(quadraticForm(crossInterference(outer(e), S), x), quadraticForm(S, cross(x, e)), 1e-11);
    // Theorem A.12 promises more than semidefiniteness and is wrong there.
    EXPECT_NEAR(quadraticForm(crossInterference(outer(e), S), e), 0, 1e-11);
  }
}

TEST(ProbabilisticTriangle, IsTheExpectedTriangle) {
  RandomGeometry random(5);
  const std::array<Vec3d, 3> corner{random.point(), random.point(), random.point()};
  const std::array<Mat3d, 3> root{random.covarianceRoot(0.2), random.covarianceRoot(0.2), random.covarianceRoot(0.2)};
  const auto sampled = sampleExpectedQuadric(1'000'000, [&] {
    std::array<Vec3d, 3> x;
    for (int k = 0; k < 3; ++k) x[k] = corner[k] + root[k] * random.point();
    return triangleQuadric(x[0], x[1], x[2]);
  });
  const Triangle t{corner, {random.covarianceOf(root[0]), random.covarianceOf(root[1]), random.covarianceOf(root[2])}};
  expectIsTheMean(sampled, t.quadric(), 2e-3);
}

TEST(ProbabilisticTriangle, PerVertexIsTheExpectedTriangle) {
  RandomGeometry random(6);
  const std::array<Vec3d, 3> corner{random.point(), random.point(), random.point()};
  const std::array<double, 3> sigma{0.3, 0.05, 0.5};
  const auto sampled = sampleExpectedQuadric(1'000'000, [&] {
    std::array<Vec3d, 3> x;
    for (int k = 0; k < 3; ++k) x[k] = corner[k] + random.point() * sigma[k];
    return triangleQuadric(x[0], x[1], x[2]);
  });
  expectIsTheMean(sampled, probabilisticTriangleQuadric(corner[0], corner[1], corner[2], sigma[0], sigma[1], sigma[2]),
                  2e-3);
}

TEST(ProbabilisticTriangle, IsotropicIsTheExpectedTriangle) {
  RandomGeometry random(7);
  const std::array<Vec3d, 3> corner{random.point(), random.point(), random.point()};
  const auto sampled = sampleExpectedQuadric(1'000'000, [&] {
    std::array<Vec3d, 3> x;
    for (int k = 0; k < 3; ++k) x[k] = corner[k] + random.point() * 0.2;
    return triangleQuadric(x[0], x[1], x[2]);
  });
  expectIsTheMean(sampled, probabilisticTriangleQuadric(corner[0], corner[1], corner[2], 0.2), 2e-3);
}

TEST(ProbabilisticTriangle, FormsAgreeWhereTheyOverlap) {
  RandomGeometry random(8);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random.point(), q = random.point(), r = random.point();
    const double sp = random.uniform(0, 1), sq = random.uniform(0, 1), sr = random.uniform(0, 1);
    const Sym I = Sym::identity();
    const auto full = probabilisticTriangleQuadric(p, q, r, I * (sp * sp), I * (sq * sq), I * (sr * sr));
    const double size = full.A.trace() * (1 + dot(p, p));
    EXPECT_LT(largestDifference(full, probabilisticTriangleQuadric(p, q, r, sp, sq, sr)), 1e-13 * size);
    const auto equal = probabilisticTriangleQuadric(p, q, r, sp, sp, sp);
    EXPECT_LT(largestDifference(probabilisticTriangleQuadric(p, q, r, sp), equal),
              1e-13 * equal.A.trace() * (1 + dot(p, p)));
  }
}

TEST(ProbabilisticTriangle, WithoutNoiseIsTheClassicalOne) {
  RandomGeometry random(9);
  for (int i = 0; i < 1000; ++i) {
    Triangle t = Triangle::random(random);
    const auto classical = t.classical();
    const auto& [p, q, r] = t.corner;
    t.Sigma.fill(Sym::zero());
    const double size = classical.A.trace() * (1 + dot(p, p));
    EXPECT_LT(largestDifference(t.quadric(), classical), 1e-14 * size);
    EXPECT_LT(largestDifference(probabilisticTriangleQuadric(p, q, r, 0.0), classical), 1e-14 * size);
    EXPECT_LT(largestDifference(probabilisticTriangleQuadric(p, q, r, 0.0, 0.0, 0.0), classical), 1e-14 * size);
  }
}

TEST(ProbabilisticTriangle, IsSymmetricInTheCorners) {
  RandomGeometry random(10);
  for (int i = 0; i < 1000; ++i) {
    const Triangle t = Triangle::random(random);
    const auto f = t.quadric();
    const double size = 1e-12 * (1 + f.A.trace()) * (1 + dot(t.corner[0], t.corner[0]) + dot(t.corner[1], t.corner[1]));
    EXPECT_LT(largestDifference(t.quadric(1), f), size);
    EXPECT_LT(largestDifference(t.quadric(2), f), size);
    const auto mirrored =
        probabilisticTriangleQuadric(t.corner[1], t.corner[0], t.corner[2], t.Sigma[1], t.Sigma[0], t.Sigma[2]);
    EXPECT_LT(largestDifference(mirrored, f), size);
  }
}

TEST(ProbabilisticTriangle, IsSymmetricInTheCornersWhereIsotropic) {
  RandomGeometry random(16);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random.point(), q = random.point(), r = random.point();
    const double sp = random.uniform(0, 1), sq = random.uniform(0, 1), sr = random.uniform(0, 1);
    const auto f = probabilisticTriangleQuadric(p, q, r, sp, sq, sr), g = probabilisticTriangleQuadric(p, q, r, sp);
    const double size = 1e-12 * (1 + f.A.trace() + g.A.trace()) * (1 + dot(p, p) + dot(q, q));
    EXPECT_LT(largestDifference(probabilisticTriangleQuadric(q, r, p, sq, sr, sp), f), size);
    EXPECT_LT(largestDifference(probabilisticTriangleQuadric(q, p, r, sq, sp, sr), f), size);
    EXPECT_LT(largestDifference(probabilisticTriangleQuadric(q, r, p, sp), g), size);
    EXPECT_LT(largestDifference(probabilisticTriangleQuadric(q, p, r, sp), g), size);
  }
}

TEST(ProbabilisticTriangle, MovesWithItsCorners) {
  RandomGeometry random(11);
  for (int i = 0; i < 1000; ++i) {
    const Triangle t = Triangle::random(random);
    const Mat3d R = random.rotation();
    const Vec3d shift = random.point(), x = random.point();
    const double before = t.quadric()(x);
    EXPECT_NEAR(t.moved(R, shift).quadric()(R * x + shift), before, 1e-10 * (1 + before));
    // An affine map multiplies volumes, whose squares triangles measure, by its determinant.
    const Mat3d M = random.matrix();
    const double squeezed = before * M.determinant() * M.determinant();
    EXPECT_NEAR(t.moved(M, shift).quadric()(M * x + shift), squeezed, 1e-9 * (1 + squeezed) * (1 + before));
    // Rotations leave isotropic noise as it is.
    const auto& [p, q, r] = t.corner;
    const auto& [mp, mq, mr] = t.moved(R, shift).corner;
    const double perVertex = probabilisticTriangleQuadric(p, q, r, 0.1, 0.2, 0.3)(x);
    EXPECT_NEAR(probabilisticTriangleQuadric(mp, mq, mr, 0.1, 0.2, 0.3)(R * x + shift), perVertex,
                1e-10 * (1 + perVertex));
    const double isotropic = probabilisticTriangleQuadric(p, q, r, 0.2)(x);
    EXPECT_NEAR(probabilisticTriangleQuadric(mp, mq, mr, 0.2)(R * x + shift), isotropic, 1e-10 * (1 + isotropic));
  }
}

TEST(ProbabilisticTriangle, ScalesWithTheUnitOfLength) {
  RandomGeometry random(12);
  for (const double L : {0x1p-10, 0x1p-3, 0x1p4, 0x1p10}) {
    const Triangle t = Triangle::random(random);
    const auto& [p, q, r] = t.corner;
    // Powers of two only shift exponents.
    const auto expectScaled = [L](const Quadric<double>& g, const Quadric<double>& f) {
      EXPECT_EQ(g.A, f.A * (L * L * L * L));
      EXPECT_EQ(g.b, f.b * (L * L * L * L * L));
      EXPECT_EQ(g.c, f.c * (L * L * L * L * L * L));
    };
    expectScaled(t.moved(Mat3d::diagonal(L, L, L), Vec3d{}).quadric(), t.quadric());
    expectScaled(triangleQuadric(p * L, q * L, r * L), t.classical());
    expectScaled(probabilisticTriangleQuadric(p * L, q * L, r * L, 0.2 * L),
                 probabilisticTriangleQuadric(p, q, r, 0.2));
    expectScaled(probabilisticTriangleQuadric(p * L, q * L, r * L, 0.1 * L, 0.2 * L, 0.3 * L),
                 probabilisticTriangleQuadric(p, q, r, 0.1, 0.2, 0.3));
  }
}

TEST(ProbabilisticTriangle, TheMinimiserBeatsRandomPoints) {
  RandomGeometry random(13);
  auto f = Quadric<double>::zero();
  for (int i = 0; i < 5; ++i) f += Triangle::random(random).quadric();
  const auto x = solveLdlt(f.A, f.b);
  ASSERT_TRUE(x);
  for (int i = 0; i < 10'000; ++i) EXPECT_LT(f(*x), f(*x + random.point() * 0.1));
}

TEST(ProbabilisticTriangle, WithOneSigmaHasItsMinimumAtTheCentroid) {
  RandomGeometry random(17);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random.point(), q = random.point(), r = random.point(), centroid = (p + q + r) * (1.0 / 3);
    const auto one = probabilisticTriangleQuadric(p, q, r, 0.2),
               each = probabilisticTriangleQuadric(p, q, r, 0.2, 0.2, 0.2);
    EXPECT_LT(length(one.halfGradient(centroid)), 1e-13 * one.A.trace() * (1 + length(p)));
    EXPECT_LT(length(each.halfGradient(centroid)), 1e-13 * each.A.trace() * (1 + length(p)));
  }
}

TEST(ProbabilisticTriangle, IsPositiveDefiniteWhereTheCornersAreCollinear) {
  const Vec3d p{-1, 0, 0}, q{0, 0, 0}, r{2, 0, 0};
  const double sigma = 0.05;
  const auto f = probabilisticTriangleQuadric(p, q, r, sigma);
  EXPECT_NEAR(f.A.xx, 6 * sigma * sigma * sigma * sigma, 1e-18)
      << "the second-order terms alone hold the line's direction";
  const auto x = solveLdlt(f.A, f.b);
  ASSERT_TRUE(x);
  EXPECT_NEAR(x->x, 1.0 / 3, 1e-12) << "the centroid, by symmetry of the noise";
  EXPECT_FALSE(solveLdlt(triangleQuadric(p, q, r).A, Vec3d{}));
}

TEST(ProbabilisticTriangle, ConstantTermHasTheFloorOfItsNoise) {
  // To first order the value at the centroid of an equilateral triangle of edge L is σ² L⁴ / 4.
  const double sigma = 1e-3, h = std::sqrt(3.0) / 2;
  const Vec3d p{-0.5, -h / 3, 0}, q{0.5, -h / 3, 0}, r{0, 2 * h / 3, 0};
  EXPECT_NEAR(probabilisticTriangleQuadric(p, q, r, sigma)(Vec3d{}), sigma * sigma / 4, 1e-11);
}

TEST(ProbabilisticTriangle, IsWhatThePaperPrints) {
  RandomGeometry random(14);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random.point(), q = random.point(), r = random.point();
    const auto f = probabilisticTriangleQuadric(p, q, r, 0.2);
    EXPECT_LT(largestDifference(f, globalFrameTriangleQuadric(p, q, r, 0.2)),
              1e-12 * (1 + f.A.trace()) * (1 + dot(p, p)));
  }
}

/// Three triangles of unit size near one point, and that point.
struct Corner {
  Vec3d origin;
  std::array<std::array<Vec3d, 3>, 3> triangle;  // Corners relative to the origin.

  Corner(RandomGeometry& random, double distance) : origin(random.direction() * distance) {
    for (auto& [p, q, r] : triangle) {
      p = random.point() * 0.3;
      q = p + random.direction();
      r = p + random.direction();
    }
  }
  /// The minimiser's position relative to the origin, by `quadric` of positions relative to `frame` in precision T.
  template <typename T, typename F>
  [[nodiscard]] Vec3d minimise(const Vec3d& frame, const F& quadric) const {
    auto f = Quadric<T>::zero();
    for (const auto& [p, q, r] : triangle)
      f += quadric(vecCast<T>(origin + p - frame), vecCast<T>(origin + q - frame), vecCast<T>(origin + r - frame),
                   T(0.3));
    const auto x = solveLdlt(f.A, f.b);
    return x ? vecCast<double>(*x) + (frame - origin) : Vec3d{INFINITY, INFINITY, INFINITY};
  }
};

TEST(ProbabilisticTriangle, LocalFramesLoseNothingFarFromTheOrigin) {
  const auto differences = [](auto p, auto q, auto r, auto sigma) {
    return probabilisticTriangleQuadric(p, q, r, sigma);
  };
  const auto printed = [](auto p, auto q, auto r, auto sigma) { return globalFrameTriangleQuadric(p, q, r, sigma); };
  RandomGeometry random(15);
  for (const double distance : {10.0, 1e3, 1e5, 1e7}) {
    double localError = 0, globalError = 0;
    for (int i = 0; i < 1000; ++i) {
      const Corner corner(random, distance);
      const Vec3d exact = corner.minimise<double>(corner.origin, differences);
      localError = std::max(localError, length(corner.minimise<float>(corner.origin, differences) - exact));
      globalError = std::max(globalError, length(corner.minimise<float>(Vec3d{}, printed) - exact));
    }
    EXPECT_LT(localError, 1e-5) << distance;
    EXPECT_GT(globalError, distance < 100 ? localError : 1) << distance;
  }
}

TEST(TriangleQuadric, NormalsSurviveFarFromTheOriginInSinglePrecision) {
  for (const float distance : {10.F, 1e3F, 1e5F}) {
    const Vec3f o{distance, 2 * distance, -distance};
    const auto f = triangleQuadric(o, o + Vec3f{1, 0, 0}, o + Vec3f{0, 1, 0});
    EXPECT_EQ(f.A, (SymMat3<float>{0, 0, 0, 0, 0, 1})) << distance;
  }
  const Vec3f o{1e5F, 2e5F, -1e5F};
  EXPECT_NE(globalFrameTriangleQuadric(o, o + Vec3f{1, 0, 0}, o + Vec3f{0, 1, 0}, 0.F).A,
            (SymMat3<float>{0, 0, 0, 0, 0, 1}));
}

}  // namespace
}  // namespace pdc
