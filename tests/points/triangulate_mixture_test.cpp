#include "pdc/points/triangulate_mixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "parallel/with_threads.h"
#include "pdc/error.h"
#include "pdc/math/gaussian_product.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/vertex_covariances.h"
#include "points/overlaps.h"
#include "points/point_shapes.h"
#include "simplify/same_bytes.h"

namespace pdc {
namespace {

/// ∫ √(f g) by sums over a lattice, for covariances of about 1.
double integralOfRoots(const Vec3d& mean, const SymMat3<double>& a, const SymMat3<double>& b) {
  const auto density = [](const Vec3d& x, const SymMat3<double>& covariance) {
    const auto inverse = inversePositive(covariance).value();
    const double determinant = 1 / (inverse.xx * (inverse.yy * inverse.zz - inverse.yz * inverse.yz) -
                                    inverse.xy * (inverse.xy * inverse.zz - inverse.yz * inverse.xz) +
                                    inverse.xz * (inverse.xy * inverse.yz - inverse.yy * inverse.xz));
    return std::exp(-0.5 * quadraticForm(inverse, x)) / std::sqrt(std::pow(2 * 3.14159265358979, 3) * determinant);
  };
  constexpr double kStep = 0.25;
  constexpr int kHalf = 36;
  double sum = 0;
  for (int i = -kHalf; i <= kHalf; ++i)
    for (int j = -kHalf; j <= kHalf; ++j)
      for (int k = -kHalf; k <= kHalf; ++k) {
        const Vec3d x{i * kStep, j * kStep, k * kStep};
        sum += std::sqrt(density(x, a) * density(x - mean, b));
      }
  return sum * kStep * kStep * kStep;
}

TEST(Overlaps, CoefficientIsTheIntegralOfTheRootOfTheProduct) {
  const SymMat3<double> a{1, 0.2, 0.1, 1.5, -0.3, 0.8}, b{2, -0.4, 0.3, 0.9, 0.1, 1.1};
  const Vec3d mean{1, -0.5, 0.7};
  EXPECT_NEAR(detail::bhattacharyya({0, 0, 0}, a, mean, b), integralOfRoots(mean, a, b), 1e-6);
  EXPECT_NEAR(detail::bhattacharyya(mean, b, mean, b), 1, 1e-14);
}

TEST(Overlaps, FindsThePairsThatALoopOverAllFinds) {
  const GaussianMixture mixture = gaussianMixture(test::noisySphere(3000, 0.05));
  const detail::Overlaps overlaps(mixture, 0.05, {});
  std::size_t pairs = 0;
  for (std::uint32_t i = 0; i < mixture.size(); ++i) {
    for (std::uint32_t j = 0; j < mixture.size(); ++j) {
      if (i == j) continue;
      const double c =
          detail::bhattacharyya(mixture.means[i], mixture.covariances[i], mixture.means[j], mixture.covariances[j]);
      ASSERT_NEAR(overlaps.coefficient(i, j), c >= 0.05 ? c : 0, 1e-12) << i << " " << j;
      pairs += c >= 0.05 ? 1 : 0;
    }
  }
  EXPECT_GT(pairs, 1000U);
}

TEST(Triangulate, CoversASphere) {
  TriangulateReport report;
  const GaussianMixture mixture = gaussianMixture(test::noisySphere(20000, 0.005));
  const Mesh mesh = triangulate(mixture, {.close = true}, &report);
  const MeshReport facts = analyze(mesh);
  EXPECT_EQ(facts.boundaryEdges, 0U);
  EXPECT_EQ(facts.nonManifoldEdges, 0U);
  EXPECT_EQ(facts.nonManifoldVertices, 0U);
  EXPECT_EQ(facts.misorientedEdges, 0U);
  EXPECT_EQ(report.components, 1U);
  EXPECT_LT(report.unusedGaussians, mixture.size() / 100);
  EXPECT_NEAR(facts.volume, 4.18879, 0.05);
  EXPECT_NEAR(facts.area, 12.566, 0.2);
  EXPECT_EQ(analyzeCovariances(mesh).definite, mesh.positions.size());
}

TEST(Triangulate, NoTriangleJoinsTwinSheetsFourDeviationsApart) {
  // The means of a sheet lie 1 apart, the sheets 0.4.
  GaussianMixture mixture;
  test::addSheet(mixture, 12, 0, 0.5, 0.1);
  test::addSheet(mixture, 12, 0.4, 0.5, 0.1);
  TriangulateReport report;
  const Mesh mesh = triangulate(mixture, {}, &report);
  EXPECT_EQ(report.components, 2U);
  EXPECT_EQ(report.boundaryLoops, 2U);
  EXPECT_EQ(report.unusedGaussians, 0U);
  for (const Triangle& t : mesh.triangles) {
    EXPECT_EQ(mesh.positions[t[0]].z, mesh.positions[t[1]].z);
    EXPECT_EQ(mesh.positions[t[0]].z, mesh.positions[t[2]].z);
  }
  // All of both: the area of the lattice, but for what its rim bends.
  EXPECT_NEAR(analyze(mesh).area, 2 * 11 * 11, 6);
}

TEST(Triangulate, ClosesAThinBox) {
  GaussianMixture mixture;
  test::addSheet(mixture, 12, 0, 0.5, 0.1);
  test::addSheet(mixture, 12, 0.4, 0.5, 0.1);
  TriangulateReport report;
  const Mesh mesh = triangulate(mixture, {.close = true}, &report);
  const MeshReport facts = analyze(mesh);
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(facts.boundaryEdges, 0U);
  EXPECT_EQ(facts.nonManifoldEdges + facts.nonManifoldVertices + facts.misorientedEdges, 0U);
  EXPECT_EQ(facts.eulerNumber, 2);
  EXPECT_NEAR(facts.volume, 11 * 11 * 0.4, 2);
}

TEST(Triangulate, TurnsEachComponentTheWayItsNormalsPoint) {
  GaussianMixture mixture;
  test::addSheet(mixture, 6, 0, 0.5, 0.1);
  test::addSheet(mixture, 6, 5, 0.5, 0.1);
  for (std::size_t i = 0; i < mixture.size(); ++i) mixture.normals.push_back({0, 0, i < 36 ? -1.0F : 1.0F});
  const Mesh mesh = triangulate(mixture);
  ASSERT_GT(mesh.triangles.size(), 80U);
  for (const Triangle& t : mesh.triangles) {
    const Vec3f &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    EXPECT_GT(cross(b - a, c - a).z * (a.z > 2 ? 1 : -1), 0);
  }
}

TEST(Triangulate, IsTheSameForAnyNumberOfThreads) {
  const GaussianMixture mixture = gaussianMixture(test::noisySphere(10000, 0.01));
  const Mesh one = detail::withThreads(1, [&] { return triangulate(mixture, {.close = true}); });
  for (const int threads : {2, 3, 8})
    EXPECT_TRUE(
        test::sameBytes(one, detail::withThreads(threads, [&] { return triangulate(mixture, {.close = true}); })));
}

TEST(Triangulate, GivesNoTrianglesWhereNothingOverlaps) {
  GaussianMixture mixture;
  test::addSheet(mixture, 5, 0, 0.01, 0.01);
  TriangulateReport report;
  EXPECT_TRUE(triangulate(mixture, {.close = true}, &report).triangles.empty());
  EXPECT_EQ(report.unusedGaussians, 25U);
}

TEST(Triangulate, RefusesWhatIsNoMixture) {
  GaussianMixture mixture;
  EXPECT_THROW((void)triangulate(mixture), Error);
  test::addSheet(mixture, 5, 0, 1, 1);
  mixture.covariances[3].xx = -1;
  EXPECT_THROW((void)triangulate(mixture), Error);
  mixture.covariances.pop_back();
  EXPECT_THROW((void)triangulate(mixture), std::invalid_argument);
  EXPECT_THROW((void)triangulate(GaussianMixture(), {.leastOverlap = 1}), std::invalid_argument);
}

}  // namespace
}  // namespace pdc
