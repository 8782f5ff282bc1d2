#include "extract/vertices/sigma_normal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

using detail::PatchSpread;
using detail::SigmaNormal;

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

/// σn where no residual tells of a crease, and where one tells of nothing else.
double smoothSigma(const SigmaNormal& sigma, const SymMat3<double>& A, double weight) {
  return std::sqrt(sigma.variance(sigma.spread(A, weight), 0.0));
}
double creaseSigma(const SigmaNormal& sigma, const SymMat3<double>& A, double weight) {
  const PatchSpread<double> spread = sigma.spread(A, weight);
  return std::sqrt(sigma.variance(spread, 0.55 * spread.excess));
}

TEST(SigmaNormal, FlatPatchesGetMoreThanCurvedOnesAndTheseMoreThanCreases) {
  const SigmaNormal sigma = SigmaNormal::ofNoise(0.05);
  const SymMat3<double> flat = sumOf({{1, 0, 0}, {1, 0.04, 0}, {1, 0, -0.05}, {1, 0.02, 0.03}}),
                        bent = sumOf({{1, 1, 0}, {1, 1, 0.04}, {1, -1, 0}, {1, -1, 0.02}});
  EXPECT_GT(smoothSigma(sigma, flat, 4), 1);
  EXPECT_NEAR(smoothSigma(sigma, bent, 4), 0.22, 0.03);
  EXPECT_LT(creaseSigma(sigma, bent, 4), 0.075);
  EXPECT_GE(creaseSigma(sigma, bent, 4), 0.05);
}

TEST(SigmaNormal, WithoutNoiseFlatPatchesAreCurvedOnesToo) {
  const SigmaNormal sigma = SigmaNormal::ofNoise(0);
  EXPECT_NEAR(smoothSigma(sigma, sumOf({{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}), 3), std::hypot(0.2, 0.02), 1e-6);
}

// Normals that disagree with the chords by more than any crease makes them are noise.
TEST(SigmaNormal, NormalsThatNoCreaseExplainsHaveNoInfluence) {
  const SigmaNormal sigma = SigmaNormal::ofNoise(0);
  const PatchSpread<double> spread = sigma.spread(sumOf({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 3.0);
  EXPECT_GT(sigma.variance(spread, 1.2 * spread.excess), 0.4);
  EXPECT_LT(sigma.variance(spread, 0.5 * spread.excess), 0.0005);
}

TEST(SigmaNormal, IsContinuousInSpreadAndResidual) {
  const SigmaNormal sigma = SigmaNormal::ofNoise(0.02);
  constexpr int kSteps = 40000;
  for (const double share : {0.0, 0.1, 0.45, 0.58, 0.62, 0.9, 1.1})
    for (int i = 1; i < kSteps; ++i) {
      const double e = 0.4 * i / kSteps, h = 0.4 / kSteps;
      const double a = sigma.variance(PatchSpread<double>{e, 0.0004}, share * e),
                   b = sigma.variance(PatchSpread<double>{e + h, 0.0004}, share * (e + h));
      ASSERT_NEAR(std::log(a), std::log(b), 0.12) << e << ' ' << share;
    }
}

TEST(SigmaNormal, APatchMayNotHaveNormals) {
  const SigmaNormal sigma = SigmaNormal::ofNoise(0.05);
  EXPECT_GT(sigma.variance(sigma.spread(SymMat3<double>{}, 3.0), 0.0), 0);
  EXPECT_GT(sigma.variance(sigma.spread(SymMat3<float>{}, 3.0F), 0.0F), 0);
}

/// A source whose normals have noise that it knows.
class KnownNoise final : public HermiteSource {
 public:
  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor&) const override { return {}; }
  [[nodiscard]] const LatticeMap& map() const override { return mMap; }
  [[nodiscard]] SourceKnowledge knowledge() const override { return {.noise = SourceKnowledge::Noise::kSigma}; }
  void fillHermite(const SurfaceBlock&, HermiteBlock&) const override {}

 private:
  LatticeMap mMap{Mat3d::identity(), Vec3d{}};
};

/// The spread straight from the definition: planes with weights and variances of their own, whose mean is taken away
/// again.
double excessByDefinition(const std::vector<Vec3d>& normals, const std::vector<double>& weights, double meanVariance) {
  Mat3d P{{Vec3d{}, Vec3d{}, Vec3d{}}};
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (int k = 0; k < 3; ++k) P.row[k] += normals[i] * (normals[i][k] * weights[i]);
  double trace = 0, traceOfSquare = 0;
  for (int k = 0; k < 3; ++k) {
    trace += P.row[k][k];
    for (int j = 0; j < 3; ++j) traceOfSquare += P.row[k][j] * P.row[j][k];
  }
  return std::max(0.0, 1 - traceOfSquare / (trace * trace) - 1.45 * meanVariance);
}

TEST(SigmaNormal, TakesEachPlanesOwnVarianceOutOfTheSpread) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const SigmaNormal sigma = SigmaNormal::fromData(KnownNoise());
  EXPECT_FALSE(sigma.needsNoise());
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
    const PatchSpread<double> spread = sigma.spread(A, weight);
    ASSERT_NEAR(spread.excess, excessByDefinition(normals, weights, variance), 1e-9);
    ASSERT_NEAR(spread.noise, variance, 1e-9);
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
  EXPECT_NEAR(sigma.spread(lattice, 3.0, H).excess, sigma.spread(world, 3.0).excess, 1e-12);
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

/// Root mean square of the distances of points from a surface.
double rms(const std::vector<Vec3d>& points, const Field& field) {
  double sum = 0;
  for (const Vec3d& p : points) {
    double value = 0;
    field.values({&p.x, &p.y, &p.z, 1}, &value);
    sum += value * value;
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

double vertexRms(const Mesh& mesh, const Field& field) {
  std::vector<Vec3d> points;
  for (const Vec3f& v : mesh.positions) points.push_back(vecCast<double>(v));
  return rms(points, field);
}

double faceRms(const Mesh& mesh, const Field& field) {
  std::vector<Vec3d> centers;
  for (const Quad& q : mesh.quads) {
    Vec3d sum{};
    for (const std::uint32_t v : q) sum += vecCast<double>(mesh.positions[v]);
    centers.push_back(sum * 0.25);
  }
  return rms(centers, field);
}

TEST(SigmaFromData, ASphereIsRounderAndABoxAsSharp) {
  const Box bounds{{-1, -1, -1}, {1, 1, 1}};
  const FieldSource ball(sphere({}, 0.8), {.box = bounds, .voxelSize = 1.0 / 16});
  ContourReport report;
  const Mesh fromData = contour(ball, {}, &report), papers = contour(ball, {.sigmaNormal = kPapersSigmaNormal});
  EXPECT_LT(vertexRms(fromData, *sphere({}, 0.8)), vertexRms(papers, *sphere({}, 0.8)));
  EXPECT_LT(faceRms(fromData, *sphere({}, 0.8)), 1.1 * faceRms(papers, *sphere({}, 0.8)));
  EXPECT_EQ(report.normalNoise, 0);
  EXPECT_NEAR(report.medianSigmaNormal, 0.2, 0.02);
  EXPECT_EQ(report.creasePatches, 0);

  const FieldPtr cube = rotate(box({}, {0.45, 0.45, 0.45}), {1, 2, 3}, 25);
  const FieldSource source(cube, {.box = bounds, .voxelSize = 1.0 / 16});
  EXPECT_LT(
      vertexRms(contour(source, {.placement = Placement::kFree}), *cube),
      1.1 * vertexRms(contour(source, {.sigmaNormal = kPapersSigmaNormal, .placement = Placement::kFree}), *cube));
}

TEST(SigmaFromData, ThreadsDoNotMatter) {
  const FieldSource source(test::drilledBox(), {.box = test::kDrilledBoxBounds, .voxelSize = 0.05});
  const Mesh one = contour(source, {.threads = 1}), three = contour(source, {.threads = 3});
  EXPECT_EQ(one.positions, three.positions);
  EXPECT_EQ(one.quads, three.quads);
  EXPECT_EQ(one.triangles, three.triangles);
}

}  // namespace
}  // namespace pdc
