#include "pdc/math/solvers.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "math/random_geometry.h"
#include "pdc/math/quadric.h"

namespace pdc {
namespace {

Eigen::Matrix3d toEigen(const SymMat3<double>& A) {
  Eigen::Matrix3d m;
  m << A.xx, A.xy, A.xz, A.xy, A.yy, A.yz, A.xz, A.yz, A.zz;
  return m;
}

Eigen::Vector3d toEigen(const Vec3d& v) { return {v.x, v.y, v.z}; }

class RandomSystem {
 public:
  explicit RandomSystem(unsigned seed) : mEngine(seed) {}
  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(mEngine); }
  Vec3d vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
  /// Sum of `planes` plane quadrics, hence of that rank.
  SymMat3<double> matrix(int planes) {
    auto A = SymMat3<double>::zero();
    for (int i = 0; i < planes; ++i) A += outer(vector());
    return A;
  }

 private:
  std::mt19937_64 mEngine;
};

TEST(SolveLdlt, AgreesWithEigen) {
  RandomSystem random(1);
  for (int i = 0; i < 10'000; ++i) {
    const auto A = random.matrix(4) + SymMat3<double>::identity() * 1e-3;
    const Vec3d b = random.vector();
    const auto x = solveLdlt(A, b);
    ASSERT_TRUE(x);
    EXPECT_LT((toEigen(A) * toEigen(*x) - toEigen(b)).norm(), 1e-12);
  }
}

TEST(SolveLdlt, RejectsWhatIsNotPositiveDefinite) {
  EXPECT_FALSE(solveLdlt(SymMat3<double>::zero(), Vec3d{1, 0, 0}));
  EXPECT_FALSE(solveLdlt(SymMat3<double>{1, 0, 0, -1, 0, 1}, Vec3d{1, 0, 0}));
  EXPECT_FALSE(solveLdlt(outer(Vec3d{1, 2, 2}), Vec3d{1, 0, 0}));
}

TEST(SolveLdlt, RejectsNanInAnyEntryOfTheMatrix) {
  const SymMat3<double> regular{3, 0.1, 0.2, 2, 0.3, 1};
  ASSERT_TRUE(solveLdlt(regular, Vec3d{1, 0, 0}));
  for (double SymMat3<double>::*entry : {&SymMat3<double>::xx, &SymMat3<double>::xy, &SymMat3<double>::xz,
                                         &SymMat3<double>::yy, &SymMat3<double>::yz, &SymMat3<double>::zz}) {
    SymMat3<double> A = regular;
    A.*entry = NAN;
    EXPECT_FALSE(solveLdlt(A, Vec3d{1, 0, 0}));
  }
}

// A quadric from a mesh, det / trace³ = 1e-17, that Cramer's rule gets wrong in the first digit; exact to the digits
// shown.
TEST(SolveLdlt, SolvesTheIllConditionedExample) {
  const SymMat3<double> A{0x1.d7da867b5f161p-19, -0x1.f3c6369462192p-19, 0x1.03c58cb3bd406p-19,
                          0x1.08ac6c93b8ae3p-18, -0x1.1324996fe104cp-19, 0x1.1e06cae5e6ca9p-20};
  const Vec3d b{-0x1.a9eed6624ae8bp-19, 0x1.c322ea6f1c304p-19, -0x1.d4fb474d5e01fp-20};
  const auto x = solveLdlt(A, b);
  ASSERT_TRUE(x);
  EXPECT_NEAR(x->x, -0.27412, 1e-4);
  EXPECT_NEAR(x->y, 0.27954, 1e-4);
  EXPECT_NEAR(x->z, -0.60392, 1e-4);
  const Vec3d residual = A * *x - b;
  EXPECT_LT(length(residual), 1e-20);
}

/// A system with eigenvalues 1 … 1/condition in a random frame.
template <typename T>
SymMat3<T> conditioned(RandomGeometry& random, double condition) {
  const auto A = congruence(SymMat3<double>{1, 0, 0, std::pow(condition, -random.uniform(0, 1)), 0, 1 / condition},
                            random.rotation());
  return {static_cast<T>(A.xx), static_cast<T>(A.xy), static_cast<T>(A.xz),
          static_cast<T>(A.yy), static_cast<T>(A.yz), static_cast<T>(A.zz)};
}

/// Expects the error within `factor` condition numbers of rounding, against a solution in extended precision.
template <typename T>
void expectErrorsNearTheCondition(double factor) {
  RandomGeometry random(5);
  const double epsilon = std::numeric_limits<T>::epsilon();
  for (double condition = 1; condition < 0.1 / epsilon && condition < 2e12; condition *= 10) {
    for (int i = 0; i < 2000; ++i) {
      const auto A = conditioned<T>(random, condition);
      const Vec3<T> b = vecCast<T>(random.point());
      const SymMat3<long double> exactA{A.xx, A.xy, A.xz, A.yy, A.yz, A.zz};
      const auto x = solveLdlt(A, b);
      const auto exact = solveLdlt(exactA, vecCast<long double>(b));
      ASSERT_TRUE(x && exact) << condition;
      const auto error = length(vecCast<long double>(*x) - *exact) / length(*exact);
      EXPECT_LT(error, factor * epsilon * condition) << condition;
    }
  }
}

TEST(SolveLdlt, ErrorsAreThoseOfTheCondition) {
  expectErrorsNearTheCondition<float>(10);
  expectErrorsNearTheCondition<double>(10);
}

TEST(SolveLdlt, DoesNotTakeRoundingForAPivot) {
  RandomGeometry random(6);
  int rejected = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3f n = vecCast<float>(random.direction());
    rejected += !solveLdlt(outer(n), n);
  }
  EXPECT_EQ(rejected, 1000);
}

TEST(SolveLdlt, DoesNotMindTheUnitOfLength) {
  RandomGeometry random(7);
  const auto A = conditioned<float>(random, 100);
  const Vec3f b = vecCast<float>(random.point());
  const auto x = solveLdlt(A, b);
  ASSERT_TRUE(x);
  for (const float scale : {0x1p-80F, 0x1p-10F, 0x1p10F, 0x1p80F})
    EXPECT_EQ(solveLdlt(A * scale, b * scale), x) << scale;
}

TEST(EigenSymmetric, AgreesWithEigen) {
  RandomSystem random(2);
  for (int i = 0; i < 10'000; ++i) {
    const auto A = random.matrix(1 + i % 4);
    const Eigen3 e = eigenSymmetric(A);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> reference(toEigen(A));
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(e.value[k], reference.eigenvalues()[2 - k], 1e-14 * A.trace());
      EXPECT_LT((toEigen(A) * toEigen(e.vector[k]) - e.value[k] * toEigen(e.vector[k])).norm(), 1e-14 * A.trace());
      EXPECT_NEAR(length(e.vector[k]), 1, 1e-14);
    }
  }
}

TEST(SolvePseudoInverse, IsTheTruncatedSvd) {
  RandomSystem random(3);
  for (int i = 0; i < 10'000; ++i) {
    const int planes = 1 + i % 3;
    const auto A = random.matrix(planes);
    const Vec3d b = A * random.vector();
    constexpr double kCutoff = 1e-3;
    Eigen::JacobiSVD<Eigen::Matrix3d> svd(toEigen(A), Eigen::ComputeFullU | Eigen::ComputeFullV);
    svd.setThreshold(kCutoff);
    int rank = 0;
    const Vec3d x = solvePseudoInverse(A, b, kCutoff, &rank);
    EXPECT_EQ(rank, svd.rank());
    EXPECT_LT((toEigen(x) - svd.solve(toEigen(b))).norm(), 1e-10);
  }
}

TEST(SolvePseudoInverse, LeavesOutNegativeEigenvalues) {
  int rank = 0;
  const SymMat3<double> indefinite{-1, 0, 0, 2, 0, 1};
  EXPECT_EQ(solvePseudoInverse(indefinite, Vec3d{1, 1, 1}, 0, &rank), (Vec3d{0, 0.5, 1}));
  EXPECT_EQ(rank, 2);
  EXPECT_EQ(solvePseudoInverse(indefinite, Vec3d{1, 1, 1}, 0.5, &rank), (Vec3d{0, 0.5, 0}));
  EXPECT_EQ(rank, 1);
}

TEST(SolvePseudoInverse, OfZeroIsZero) {
  int rank = 3;
  EXPECT_EQ(solvePseudoInverse(SymMat3<double>::zero(), Vec3d{1, 2, 3}, 1e-3, &rank), Vec3d{});
  EXPECT_EQ(rank, 0);
}

TEST(MinimizeNear, IsTheNearestOfTheMinimisers) {
  RandomSystem random(8);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d x0 = random.vector(), reference = random.vector();
    const Vec3d n = random.vector();
    int rank = 0;
    const Vec3d x = minimizeNear(planeQuadric(x0, n), reference, 1e-3, &rank);
    EXPECT_EQ(rank, 1);
    EXPECT_LT(length(x - (reference - n * (dot(n, reference - x0) / dot(n, n)))), 1e-12);
  }
}

TEST(MinimizeInBox, AgreesWithProjectedDescent) {
  RandomSystem random(9);
  const Box box{{-0.2, 0.1, -1}, {0.3, 0.4, 0.5}};
  for (int i = 0; i < 500; ++i) {
    const auto A = random.matrix(3) + SymMat3<double>::identity() * 0.02;
    const Vec3d b = A * (random.vector() * random.uniform(0.1, 3));
    const Vec3d x = minimizeInBox(A, b, *solveLdlt(A, b), box);
    Vec3d y = box.center();
    const double step = 1 / A.trace();
    for (int k = 0; k < 20'000; ++k) {
      y -= (A * y - b) * step;
      for (int a = 0; a < 3; ++a) y[a] = std::clamp(y[a], box.lo[a], box.hi[a]);
    }
    EXPECT_LT(length(x - y), 1e-6) << i;
  }
}

// Projected gradient descent knows nothing of faces and edges of the cube, and finds the same point.
TEST(MinimizeInCube, AgreesWithProjectedDescent) {
  RandomSystem random(4);
  for (int i = 0; i < 2'000; ++i) {
    const auto A = random.matrix(3) + SymMat3<double>::identity() * 0.02;
    const Vec3d b = A * (random.vector() * random.uniform(0.1, 3));
    const Vec3d x = minimizeInCube(A, b, *solveLdlt(A, b), 0.5);
    Vec3d y{};
    const double step = 1 / A.trace();
    for (int k = 0; k < 20'000; ++k) {
      y -= (A * y - b) * step;
      for (int a = 0; a < 3; ++a) y[a] = std::clamp(y[a], -0.5, 0.5);
    }
    EXPECT_LT(length(x - y), 1e-6) << i;
  }
}

TEST(MinimizeInCube, LeavesPointsInsideAlone) {
  const auto A = SymMat3<double>::identity();
  const Vec3d inside{0.1, -0.5, 0.3};
  EXPECT_EQ(minimizeInCube(A, inside, inside, 0.5), inside);
}

}  // namespace
}  // namespace pdc
