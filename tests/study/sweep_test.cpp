#include "pdc/study/sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "pdc/sample/crease_points.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_source.h"
#include "sample/creases/noisy_part.h"

namespace pdc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const std::vector<double> kSigmas{0, 0.02, 0.05, 0.1, 0.15, 0.25, 0.5, kInfinity};

/// The faces lie half-way between planes of the finest lattice: on them even mass points would be exact.
FieldSource exactPart(double voxelSize = 0.05) {
  Box box = test::kDrilledBoxBounds;
  box.lo = box.lo - Vec3d{0.025, 0.025, 0.025};
  return {test::drilledBox(), {.box = box, .voxelSize = voxelSize}};
}

SweepTruth truthOf(const FieldSource& source) {
  return {.field = source.levelField(), .reference = nullptr, .creases = creasePoints(source.levelField(), source)};
}

double trueError(const SweepStep& step) { return std::hypot(step.vertexRms.value(), step.creaseRms.value()); }

double lowestError(const Sweep& sweep) {
  double lowest = kInfinity;
  for (const SweepStep& s : sweep.steps) lowest = std::min(lowest, trueError(s));
  return lowest;
}

/// Steps from step i to the nearest one with the lowest true error; with one that is the same but for a thousandth.
int stepsToLowest(const Sweep& sweep, std::size_t i) {
  constexpr double kSame = 1.001;
  const double lowest = lowestError(sweep);
  int steps = static_cast<int>(sweep.steps.size());
  for (std::size_t k = 0; k < sweep.steps.size(); ++k)
    if (trueError(sweep.steps[k]) <= kSame * lowest)
      steps = std::min(steps, std::abs(static_cast<int>(k) - static_cast<int>(i)));
  return steps;
}

TEST(SweepSigma, MeshesAreThoseOfContour) {
  const FieldSource source = exactPart();
  for (const Placement placement : {Placement::kCertified, Placement::kCell, Placement::kFree}) {
    const Sweep sweep =
        sweepSigma(source, {0.25, 0, kInfinity}, {.contour = {.placement = placement, .threads = 2}, .truth = {}});
    ASSERT_EQ(sweep.meshes.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      const Mesh alone = contour(source, {.sigmaNormal = sweep.steps[i].value, .placement = placement});
      EXPECT_EQ(sweep.meshes[i].positions, alone.positions);
      EXPECT_EQ(sweep.meshes[i].quads, alone.quads);
      EXPECT_EQ(sweep.meshes[i].triangles, alone.triangles);
    }
  }
}

// The estimate knows nothing but the noisy grid, and is held to the truth that it was made from.
TEST(SweepSigma, RecommendationForANoisyLevelSetIsWithinAStepOfTheLowestTrueError) {
  const SweepTruth truth = truthOf(exactPart());
  struct Case {
    HermiteMode hermite;
    double noise;
  };
  // With planes from distances, which have a σn of their own, many of the sweep's give the same mesh.
  for (const auto& [hermite, noise] :
       {Case{HermiteMode::kGradient, 0.1}, Case{HermiteMode::kGradient, 0.2}, Case{HermiteMode::kAuto, 0.1}}) {
    const GridSource source(test::noisyLevelSet(0.05, noise, 1), {.hermite = hermite});
    SweepOptions options;
    const Sweep blind = sweepSigma(source, kSigmas, options);
    options.truth = truth;
    const Sweep knowing = sweepSigma(source, kSigmas, options);
    ASSERT_TRUE(blind.recommended && knowing.recommended);
    EXPECT_LE(stepsToLowest(knowing, *blind.recommended), 1) << noise << " " << blind.reason;
    EXPECT_EQ(trueError(knowing.steps[*knowing.recommended]), lowestError(knowing)) << knowing.reason;
    EXPECT_NE(blind.reason.find("not known"), std::string::npos) << blind.reason;
  }
}

TEST(SweepSigma, FlatCurvesRecommendNothing) {
  const FieldSource source(sphere({0, 0, 0}, 1), {.box = {{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}}, .voxelSize = 0.1});
  const Sweep sweep = sweepSigma(source, {0.05, 0.051}, {.contour = {}, .truth = {.field = source.levelField()}});
  EXPECT_FALSE(sweep.recommended);
  EXPECT_NE(sweep.reason.find("flat"), std::string::npos) << sweep.reason;
}

TEST(SweepSigma, MeasuresOfAnExactPart) {
  const FieldSource source = exactPart();
  SweepOptions options;
  options.truth = truthOf(source);
  const Sweep sweep = sweepSigma(source, {0, kInfinity}, options);
  const SweepStep &sharp = sweep.steps[0], &blunt = sweep.steps[1];
  EXPECT_LT(*sharp.vertexRms, 0.02);
  EXPECT_LT(*sharp.creaseRms, 0.06);
  EXPECT_LE(*sharp.creaseRms, *sharp.creaseMax);
  // Mass points lie a quarter of a voxel from both faces of an edge that passes the middles of cells.
  EXPECT_NEAR(*blunt.creaseRms, std::sqrt(2.0) / 4, 0.02);
  EXPECT_LT(sharp.roughness, 0.02);
  EXPECT_EQ(sharp.eulerNumber, 0);
  EXPECT_EQ(sharp.selfIntersections, 0u);
  EXPECT_EQ(sharp.vertices, sweep.meshes[0].positions.size());
  for (const SweepStep& step : sweep.steps) {
    EXPECT_DOUBLE_EQ(step.voxelSize, 0.05);
    EXPECT_LE(step.minimumAngle[0], step.minimumAngle[1]);
    EXPECT_LE(step.minimumAngle[1], step.minimumAngle[2]);
    EXPECT_LE(step.minimumAngle[2], 60);
  }
}

TEST(SweepSigma, AReferenceMeshIsATruthToo) {
  const FieldSource source = exactPart();
  const auto reference = std::make_shared<Mesh>(contour(source, {.sigmaNormal = 0}));
  const Sweep sweep = sweepSigma(source, {0, 0.5}, {.contour = {}, .truth = {.reference = reference}});
  EXPECT_LT(*sweep.steps[0].vertexRms, 1e-5);
  EXPECT_GT(*sweep.steps[1].vertexRms, 0.01);
  EXPECT_FALSE(sweep.steps[0].creaseRms);
  EXPECT_EQ(sweep.recommended, 0u);
}

TEST(SweepInputs, ErrorsOfASphereFallWithTheVoxelSize) {
  const auto open = [](double voxelSize) {
    auto source = std::make_unique<FieldSource>(
        sphere({0, 0, 0}, 1), FieldSourceOptions{.box = {{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}}, .voxelSize = voxelSize});
    SweepTruth truth{.field = source->levelField()};
    return SweepInput{std::move(source), std::move(truth)};
  };
  const Sweep sweep = sweepInputs(SweepParameter::kVoxelSize, {0.2, 0.1, 0.05}, open, {});
  ASSERT_EQ(sweep.steps.size(), 3u);
  for (std::size_t i = 1; i < 3; ++i) {
    const SweepStep &coarse = sweep.steps[i - 1], &fine = sweep.steps[i];
    EXPECT_LT(*fine.vertexMax * fine.voxelSize, 0.5 * *coarse.vertexMax * coarse.voxelSize);
    EXPECT_EQ(fine.eulerNumber, 2);
  }
  EXPECT_FALSE(sweep.recommended);
}

TEST(SweepAdaptive, MeshesAreThoseOfContour) {
  const FieldSource source = exactPart(0.1);
  SweepOptions options;
  options.contour.sigmaNormal = 0.05;
  options.truth = truthOf(source);
  const Sweep sweep = sweepAdaptive(source, {0, 0.05, 0.25}, options);
  ASSERT_EQ(sweep.steps.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const SweepStep& step = sweep.steps[i];
    const Mesh& mesh = sweep.meshes[i];
    ContourOptions alone{.sigmaNormal = 0.05};
    if (step.value > 0) alone.adaptive = step.value * step.voxelSize;
    EXPECT_EQ(mesh.positions, contour(source, alone).positions);
    EXPECT_EQ(step.triangles, mesh.triangles.size() + 2 * mesh.quads.size());
    EXPECT_EQ(step.adaptedMax.has_value(), i > 0);
    EXPECT_EQ(step.eulerNumber, 0);
    if (i == 0) continue;
    EXPECT_LT(step.triangles, sweep.steps[i - 1].triangles);
    EXPECT_GT(*step.adaptedMax, 0);
    EXPECT_LE(*step.adaptedMax, step.value * (1 + 1e-5));
  }
  EXPECT_LT(*sweep.steps[1].vertexRms, 0.1);
  EXPECT_FALSE(sweep.recommended);
  EXPECT_NE(sweep.reason.find("Nothing is recommended"), std::string::npos) << sweep.reason;
}

TEST(SweepSigma, MeshesMayBeAdaptiveInVoxels) {
  const FieldSource source = exactPart(0.1);
  const Sweep sweep = sweepSigma(source, {0, 0.25}, {.contour = {}, .truth = {}, .adaptive = 0.1});
  for (std::size_t i = 0; i < 2; ++i) {
    const Mesh alone =
        contour(source, {.sigmaNormal = sweep.steps[i].value, .adaptive = 0.1 * sweep.steps[i].voxelSize});
    EXPECT_EQ(sweep.meshes[i].positions, alone.positions);
    EXPECT_LE(sweep.steps[i].adaptedMax.value(), 0.1 * (1 + 1e-5));
  }
}

TEST(Sweep, Refusals) {
  const FieldSource source = exactPart(0.2);
  EXPECT_THROW(static_cast<void>(sweepSigma(source, {}, {})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(sweepSigma(source, {0.1, -1}, {})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(sweepSigma(source, {std::nan("")}, {})), std::invalid_argument);
  for (const double distance : {-0.1, std::nan(""), kInfinity})
    EXPECT_THROW(static_cast<void>(sweepAdaptive(source, {0, distance}, {})), std::invalid_argument) << distance;
  EXPECT_THROW(static_cast<void>(sweepInputs(SweepParameter::kAdaptive, {0.1}, {}, {})), std::invalid_argument);
  const std::atomic<bool> stop = true;
  EXPECT_THROW(static_cast<void>(sweepSigma(source, {0.1}, {}, {.stop = &stop})), Cancelled);
}

}  // namespace
}  // namespace pdc
