#include "extract/vertices/sigma_normal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "pdc/extract/contour.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/math/mat3.h"
#include "pdc/math/quadric.h"
#include "pdc/math/solvers.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/study/sweep.h"
#include "sample/creases/noisy_part.h"

namespace pdc {
namespace {

using detail::SigmaNormal;

constexpr std::optional<double> kFromData{};

SymMat3<double> sumOf(std::initializer_list<Vec3d> normals) {
  SymMat3<double> A{};
  for (const Vec3d& n : normals) A += outer(n * (1 / length(n)));
  return A;
}

TEST(SigmaNormal, OneForAllIsItsSquare) {
  const SigmaNormal sigma(0.25);
  EXPECT_FALSE(sigma.ofPatches());
  EXPECT_EQ(sigma.variance(), 0.0625);
}

TEST(SigmaNormal, FlatPatchesGetMoreThanCreases) {
  const SigmaNormal sigma = SigmaNormal::ofNoise(0.05);
  const double flat = sigma.variance(sumOf({{1, 0, 0}, {1, 0.04, 0}, {1, 0, -0.05}, {1, 0.02, 0.03}}), 4.0),
               crease = sigma.variance(sumOf({{1, 1, 0}, {1, 1, 0.04}, {1, -1, 0}, {1, -1, 0.02}}), 4.0);
  EXPECT_GT(std::sqrt(flat), 0.6);
  EXPECT_LT(std::sqrt(crease), 0.075);
  EXPECT_GT(std::sqrt(crease), 0.05);
}

TEST(SigmaNormal, APatchMayNotHaveNormals) {
  EXPECT_GT(SigmaNormal::ofNoise(0.05).variance(SymMat3<double>{}, 3.0), 0);
  EXPECT_GT(SigmaNormal::ofNoise(0.05).variance(SymMat3<float>{}, 3.0F), 0);
}

/// σn² straight from the definition: planes with weights and variances of their own, whose mean is taken away again.
double varianceByDefinition(const std::vector<Vec3d>& normals, const std::vector<double>& weights,
                            double meanVariance) {
  Mat3d P{{Vec3d{}, Vec3d{}, Vec3d{}}};
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (int k = 0; k < 3; ++k) P.row[k] += normals[i] * (normals[i][k] * weights[i]);
  double trace = 0, traceOfSquare = 0;
  for (int k = 0; k < 3; ++k) {
    trace += P.row[k][k];
    for (int j = 0; j < 3; ++j) traceOfSquare += P.row[k][j] * P.row[j][k];
  }
  const double spread = (1 - traceOfSquare / (trace * trace)) / (0.01 + 4 * meanVariance);
  const double flat = 0.7 + 4 * std::sqrt(meanVariance);
  return 0.02 * 0.02 + flat * flat / (1 + spread * spread);
}

TEST(SigmaNormal, TakesEachPlanesOwnVarianceOutOfTheSpread) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const SigmaNormal sigma = SigmaNormal::ofOwnNoise();
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec3d> normals;
    std::vector<double> weights;
    SymMat3<double> A{};
    double weight = 0;
    const double variance = 0.02 * (1 + uniform(engine));
    for (int i = 0; i < 5; ++i) {
      Vec3d n{1, 0.4 * uniform(engine), 0.4 * uniform(engine)};
      n *= 1 / length(n);
      const double w = 1.5 + uniform(engine);
      normals.push_back(n);
      weights.push_back(w);
      A += outer(n).plusDiagonal(variance) * w;
      weight += w;
    }
    ASSERT_NEAR(sigma.variance(A, weight), varianceByDefinition(normals, weights, variance), 1e-9);
  }
}

// Rows are Mᵀn: in their metric G = MᵀM they say the same.
TEST(SigmaNormal, TheMetricDoesNotMatter) {
  const Mat3d M{{Vec3d{1.3, 0.2, 0}, Vec3d{-0.1, 0.7, 0.3}, Vec3d{0, 0.4, 1.1}}}, K = inverse(M);
  const Vec3d normals[] = {{1, 0, 0}, {0.9, 0.3, 0}, {0.8, 0, 0.5}};
  SymMat3<double> world{}, lattice{}, H{};
  for (Vec3d n : normals) {
    n *= 1 / length(n);
    world += outer(n);
    lattice += outer(M.transposed() * n);
  }
  for (int i = 0; i < 3; ++i) H += outer(K.column(i));
  const SigmaNormal sigma = SigmaNormal::ofNoise(0.05);
  EXPECT_NEAR(sigma.variance(lattice, 3.0, H), sigma.variance(world, 3.0), 1e-12);
}

// Own noise is in the matrix already; only what is flat gets more.
TEST(SigmaNormal, OwnNoiseIsSeenInTheMatrix) {
  const SymMat3<double> flat = sumOf({{1, 0, 0}, {1, 0.04, 0}, {1, 0, -0.05}});
  const double noise = 0.15, v = noise * noise;
  const SymMat3<double> own = flat + SymMat3<double>::identity() * (3 * v);
  const double expected = SigmaNormal::ofNoise(noise).variance(flat, 3.0) - v + 0.02 * 0.02;
  EXPECT_NEAR(SigmaNormal::ofOwnNoise().variance(own, 3.0), expected, 1e-9);
  EXPECT_NEAR(SigmaNormal::ofOwnNoise().variance(own * 7.0, 21.0), expected, 1e-9);
}

// Why there is no option for tangential noise.
TEST(SigmaNormal, TangentialNoiseIsIsotropicNoiseOfAnotherSize) {
  const double sigma = 0.4, isotropic = sigma / std::sqrt(1 - sigma * sigma);
  Quadric<double> a = Quadric<double>::zero(), b = a;
  const Vec3d normals[] = {{1, 0, 0}, {0.8, 0.6, 0}, {0, 0.6, 0.8}};
  const Vec3d points[] = {{0.1, 0.4, -0.3}, {0.2, 0, 0.1}, {-0.3, 0.2, 0.5}};
  for (int i = 0; i < 3; ++i) {
    a += probabilisticPlaneQuadric(points[i], normals[i], tangentialCovariance(normals[i], sigma));
    b += probabilisticPlaneQuadric(points[i], normals[i], isotropic, 0.0);
  }
  EXPECT_LT(length(*solveLdlt(a.A, a.b) - *solveLdlt(b.A, b.b)), 1e-12);
}

double vertexRms(const Mesh& mesh, const Field& field) {
  double sum = 0;
  for (const Vec3f& v : mesh.positions) {
    const Vec3d p = vecCast<double>(v);
    double value = 0;
    field.values({&p.x, &p.y, &p.z, 1}, &value);
    sum += value * value;
  }
  return std::sqrt(sum / static_cast<double>(mesh.positions.size()));
}

TEST(SigmaFromData, ASphereIsRounderAndABoxAsSharp) {
  const Box bounds{{-1, -1, -1}, {1, 1, 1}};
  const FieldSource ball(sphere({}, 0.8), {.box = bounds, .voxelSize = 1.0 / 16});
  ContourReport report;
  const Mesh fromData = contour(ball, {.sigmaNormal = kFromData}, &report);
  EXPECT_LT(vertexRms(fromData, *sphere({}, 0.8)), 0.6 * vertexRms(contour(ball), *sphere({}, 0.8)));
  EXPECT_GT(report.normalNoise, 0);
  EXPECT_LT(report.normalNoise, 0.1);

  const FieldPtr cube = rotate(box({}, {0.45, 0.45, 0.45}), {1, 2, 3}, 25);
  const FieldSource source(cube, {.box = bounds, .voxelSize = 1.0 / 16});
  EXPECT_LT(vertexRms(contour(source, {.sigmaNormal = kFromData, .placement = Placement::kFree}), *cube),
            1.1 * vertexRms(contour(source, {.placement = Placement::kFree}), *cube));
}

TEST(SigmaFromData, ThreadsDoNotMatter) {
  const FieldSource source(test::drilledBox(), {.box = test::kDrilledBoxBounds, .voxelSize = 0.05});
  const Mesh one = contour(source, {.sigmaNormal = kFromData, .threads = 1}),
             three = contour(source, {.sigmaNormal = kFromData, .threads = 3});
  EXPECT_EQ(one.positions, three.positions);
  EXPECT_EQ(one.quads, three.quads);
  EXPECT_EQ(one.triangles, three.triangles);
}

}  // namespace
}  // namespace pdc
