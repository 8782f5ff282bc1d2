#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "extract/sign_source.h"
#include "pdc/extract/contour.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/math/solvers.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc {
namespace {

constexpr double kVoxel = 0.05, kSigma = 0.1;

FieldSource sphereSource() {
  return FieldSource(sphere({}, 0.8), {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = kVoxel});
}

TEST(VertexQuadrics, AreHandedOutOnRequestOnly) {
  ContourReport report;
  static_cast<void>(contour(sphereSource(), {}, &report));
  EXPECT_TRUE(report.quadrics.empty());
  EXPECT_THROW(static_cast<void>(contour(sphereSource(), {.quadrics = true})), std::invalid_argument);
}

// A has a plane's nnᵀ + σn² I for each of a patch's three to twelve crossings: its trace tells their number.
TEST(VertexQuadrics, SumAPatchsProbabilisticPlanesInWorldUnits) {
  ContourReport report;
  const Mesh mesh = contour(sphereSource(), {.sigmaNormal = kSigma, .placement = Placement::kFree}, &report);
  ASSERT_TRUE(report.quadrics.empty());
  const Mesh same =
      contour(sphereSource(), {.sigmaNormal = kSigma, .placement = Placement::kFree, .quadrics = true}, &report);
  EXPECT_EQ(same.positions, mesh.positions);
  ASSERT_EQ(report.quadrics.size(), mesh.positions.size());
  for (const Quadric<float>& q : report.quadrics) {
    const double planes = double{q.A.trace()} / (1 + 3 * kSigma * kSigma);
    ASSERT_NEAR(planes, std::round(planes), 1e-4);
    ASSERT_GE(std::round(planes), 3);
    ASSERT_LE(std::round(planes), 12);
  }
}

// The origin is the vertex: where it is the minimiser, the gradient there, -2b, is zero, and the constant is the mean
// square of what curvature and σn leave.
TEST(VertexQuadrics, HaveTheirMinimumAtFreeVertices) {
  ContourReport report;
  const Mesh mesh =
      contour(sphereSource(), {.sigmaNormal = kSigma, .placement = Placement::kFree, .quadrics = true}, &report);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Quadric<float>& q = report.quadrics[i];
    ASSERT_LT(length(q.b), 2e-5 * kVoxel) << i;
    ASSERT_GT(q.c, 0) << i;
    ASSERT_LT(q.c, 12 * (kSigma * kVoxel) * (kSigma * kVoxel)) << i;
    const Vec3f aside{0.01F, 0.02F, -0.01F};
    ASSERT_GT(q(aside), q.c) << i;
  }
}

/// The value of a sum of planes through exact places of the surface, straight from the definition.
TEST(VertexQuadrics, MeasureDistancesToTheSurfacesPlanes) {
  const auto slab = box({}, {0.6, 0.61, 0.37});
  const FieldSource source(slab, {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = kVoxel});
  ContourReport report;
  const Mesh mesh = contour(source, {.sigmaNormal = 0.0, .placement = Placement::kFree, .quadrics = true}, &report);
  std::size_t flat = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3f p = mesh.positions[i];
    if (!(std::abs(p.x) < 0.5F && std::abs(p.y) < 0.5F)) continue;
    ++flat;
    const Quadric<float>& q = report.quadrics[i];
    const float planes = q.A.trace(), off = 0.37F - std::abs(p.z), step = p.z > 0 ? 0.02F : -0.02F;
    ASSERT_NEAR(q.c, planes * off * off, 1e-9);
    ASSERT_NEAR(q({0.3F, -0.2F, step}), planes * (off - 0.02F) * (off - 0.02F), 1e-6);
  }
  EXPECT_GT(flat, 400u);
}

TEST(VertexQuadrics, VerticesThatCertifyingAddsHaveOneToo) {
  std::mt19937 engine(5);
  std::bernoulli_distribution inside(0.5);
  SignSource source(24);
  for (int i = 0; i < 24 * 24 * 24; ++i) source.set(i / 576, i / 24 % 24, i % 24, inside(engine));
  ContourReport report;
  const Mesh mesh = contour(source, {.sigmaNormal = kPapersSigmaNormal, .quadrics = true}, &report);
  ASSERT_GT(report.fans, 10u);
  ASSERT_EQ(report.quadrics.size(), mesh.positions.size());
  for (const Quadric<float>& q : report.quadrics) {
    ASSERT_GT(q.A.trace(), 0);
    ASSERT_TRUE(std::isfinite(q.c) && std::isfinite(length(q.b)));
  }
}

TEST(VertexQuadrics, DoNotDependOnThreads) {
  ContourReport one, many;
  static_cast<void>(contour(sphereSource(), {.quadrics = true, .threads = 1}, &one));
  static_cast<void>(contour(sphereSource(), {.quadrics = true, .threads = 3}, &many));
  EXPECT_EQ(one.quadrics, many.quadrics);
}

}  // namespace
}  // namespace pdc
