#include "extract/vertices/vertex_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

#include "pdc/math/solvers.h"

namespace pdc::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::Vector3d toEigen(const Vec3d& v) { return {v.x, v.y, v.z}; }
Vec3d fromEigen(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Planes near the centre of a cell with `normals` distinct directions, in world units of a lattice with the given
/// metric.
class RandomPatch {
 public:
  explicit RandomPatch(unsigned seed) : mEngine(seed) {}

  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(mEngine); }
  Vec3d vector() { return {uniform(-0.5, 0.5), uniform(-0.5, 0.5), uniform(-0.5, 0.5)}; }

  PatchSamples samples(int count, int normals, const CellMetric& metric) {
    std::array<Vec3d, 3> n;
    for (int i = 0; i < normals; ++i) {
      n[i] = vector();
      n[i] *= 1 / length(n[i]);
    }
    PatchSamples s;
    s.size = count;
    for (int i = 0; i < count; ++i) {
      s.position[i] = vector();
      normal[i] = n[i % normals];
      s.row[i] = metric.M.transposed() * normal[i];
    }
    return s;
  }

  std::array<Vec3d, PatchSamples::kMax> normal;  ///< World normals of the last samples().

 private:
  std::mt19937_64 mEngine;
};

const CellMetric kUniform(Mat3d::identity() * 0.25, 0.25);
const CellMetric kSheared(Mat3d{{Vec3d{1.0, 0.4, 0.0}, Vec3d{-0.2, 2.0, 0.3}, Vec3d{0.1, 0.0, 5.0}}}, 2.0);

Vec3d massPoint(const PatchSamples& s) {
  Vec3d m{};
  for (int i = 0; i < s.size; ++i) m += s.position[i] * (1.0 / s.size);
  return m;
}

TEST(VertexSolver, UniformLatticesNeedNoMetric) {
  EXPECT_TRUE(kUniform.identity);
  EXPECT_FALSE(kSheared.identity);
}

TEST(VertexSolver, InfiniteNoiseGivesTheMassPoint) {
  RandomPatch random(1);
  for (const auto& metric : {kUniform, kSheared})
    for (const double halfSize : {detail::kCellHalfSize, detail::kFreeHalfSize}) {
      const PatchSamples s = random.samples(5, 3, metric);
      EXPECT_LT(length(VertexSolver(kInfinity, halfSize).solve(s, metric).x - massPoint(s)), 1e-14);
    }
}

// The classical quadric: least squares by SVD in world space, about the mass point, small singular values cut.
TEST(VertexSolver, NoNoiseGivesTheClassicalMinimiser) {
  RandomPatch random(2);
  int compared = 0;
  for (const auto& metric : {kUniform, kSheared})
    for (int i = 0; i < 3000; ++i) {
      const int count = 3 + i % 6;
      const PatchSamples s = random.samples(count, 1 + i % 3, metric);
      const Vec3d m = massPoint(s);
      Eigen::MatrixXd N(count, 3);
      Eigen::VectorXd d(count);
      const Mat3d K = inverse(metric.M);
      for (int k = 0; k < count; ++k) {
        N.row(k) = toEigen(random.normal[k]).transpose();
        d[k] = dot(random.normal[k], metric.M * (s.position[k] - m));
      }
      Eigen::JacobiSVD<Eigen::MatrixXd> svd(N, Eigen::ComputeThinU | Eigen::ComputeThinV);
      svd.setThreshold(std::sqrt(1e-3));
      const Vec3d expected = m + K * fromEigen(svd.solve(d));
      const SolvedVertex v = VertexSolver(0, detail::kFreeHalfSize).solve(s, metric);
      const double nearCut = svd.singularValues()[std::min(count, 3) - 1] / svd.singularValues()[0] / std::sqrt(1e-3);
      if (v.moved || (nearCut > 0.99 && nearCut < 1.01)) continue;
      ++compared;
      EXPECT_LT(length(v.x - expected), 1e-9);
    }
  EXPECT_GT(compared, 2000);
}

// Equations 6-8 in world space, solved by Eigen, whatever the lattice.
TEST(VertexSolver, MinimisesTheProbabilisticQuadricInWorldSpace) {
  RandomPatch random(3);
  for (const auto& metric : {kUniform, kSheared})
    for (int i = 0; i < 2000; ++i) {
      const double sigma = std::pow(10, random.uniform(-2, 1));
      const PatchSamples s = random.samples(3 + i % 6, 1 + i % 3, metric);
      Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
      Eigen::Vector3d b = Eigen::Vector3d::Zero();
      for (int k = 0; k < s.size; ++k) {
        const Eigen::Vector3d n = toEigen(random.normal[k]), q = toEigen(metric.M * s.position[k]);
        const Eigen::Matrix3d a = n * n.transpose() + sigma * sigma * Eigen::Matrix3d::Identity();
        A += a;
        b += a * q;
      }
      const Vec3d expected = inverse(metric.M) * fromEigen(A.ldlt().solve(b));
      const SolvedVertex v = VertexSolver(sigma, detail::kFreeHalfSize).solve(s, metric);
      EXPECT_TRUE(v.moved || length(v.x - expected) < 1e-8) << sigma;
      EXPECT_EQ(v.moved, std::max({std::abs(expected.x), std::abs(expected.y), std::abs(expected.z)}) > 2.0);
    }
}

TEST(VertexSolver, StaysInTheCellAndIsTheBestPointThere) {
  RandomPatch random(4);
  int moved = 0;
  for (const double sigma : {0.0, 0.05, 0.3})
    for (const auto& metric : {kUniform, kSheared})
      for (int i = 0; i < 300; ++i) {
        const PatchSamples s = random.samples(4, 3, metric);
        const SolvedVertex v = VertexSolver(sigma, detail::kCellHalfSize).solve(s, metric);
        const SolvedVertex unbounded = VertexSolver(sigma, detail::kFreeHalfSize).solve(s, metric);
        EXPECT_LE(std::max({std::abs(v.x.x), std::abs(v.x.y), std::abs(v.x.z)}), 0.5);
        EXPECT_EQ(v.outOfCell, unbounded.outOfCell);
        moved += v.moved;
        if (sigma == 0 || !v.moved) continue;
        auto q = Quadric<double>::zero();
        for (int k = 0; k < s.size; ++k)
          q += probabilisticPlaneQuadric(s.position[k], s.row[k], metric.G * (sigma * sigma));
        for (int k = 0; k < 200; ++k) EXPECT_LT(q(v.x), q(random.vector()) + 1e-3) << i;
      }
  EXPECT_GT(moved, 100);
}

TEST(VertexSolver, WorksWithoutAnyNormal) {
  RandomPatch random(5);
  for (const double sigma : {0.0, 1e-9, 0.05}) {
    PatchSamples s = random.samples(4, 3, kUniform);
    s.row.fill({});
    const SolvedVertex v = VertexSolver(sigma, detail::kCellHalfSize).solve(s, kUniform);
    EXPECT_LT(length(v.x - massPoint(s)), 1e-12);
  }
}

TEST(VertexSolver, MirrorsWithItsInput) {
  RandomPatch random(6);
  PatchSamples s = random.samples(5, 3, kUniform);
  const VertexSolver solver(0.05, detail::kCellHalfSize);
  const Vec3d x = solver.solve(s, kUniform).x;
  for (int k = 0; k < s.size; ++k) {
    s.position[k].x *= -1;
    s.row[k].x *= -1;
  }
  const Vec3d y = solver.solve(s, kUniform).x;
  EXPECT_NEAR(y.x, -x.x, 1e-13);
  EXPECT_NEAR(y.y, x.y, 1e-13);
  EXPECT_NEAR(y.z, x.z, 1e-13);
}

}  // namespace
}  // namespace pdc::detail
