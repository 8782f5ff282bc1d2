#include "pdc/math/solvers.h"

#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

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
  EXPECT_FALSE(solveLdlt(SymMat3<double>{NAN, 0, 0, 1, 0, 1}, Vec3d{1, 0, 0}));
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

TEST(SolvePseudoInverse, OfZeroIsZero) {
  int rank = 3;
  EXPECT_EQ(solvePseudoInverse(SymMat3<double>::zero(), Vec3d{1, 2, 3}, 1e-3, &rank), Vec3d{});
  EXPECT_EQ(rank, 0);
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
