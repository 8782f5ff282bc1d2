#include "sample/vdb/noise_grids.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "pdc/extract/contour.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/sampled_source.h"

namespace pdc {
namespace {

using openvdb::FloatGrid;
using Noise = SourceKnowledge::Noise;

constexpr float kVoxel = 0.1F;

FloatGrid::Ptr sphere() { return openvdb::tools::createLevelSetSphere<FloatGrid>(1.5F, {0, 0, 0}, kVoxel); }

/// A grid of one value with another grid's transform and active voxels.
FloatGrid::Ptr companion(const FloatGrid& grid, float value) {
  auto out = FloatGrid::create(value);
  out->setTransform(grid.transform().copy());
  for (auto it = grid.cbeginValueOn(); it; ++it) out->tree().setValue(it.getCoord(), value);
  return out;
}

/// Calls visit(noise, hermite, edges) for each block; there is at least one.
template <typename Visit>
void forEachBlock(const GridSource& source, Visit&& visit) {
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  const auto hermite = std::make_unique<HermiteBlock>();
  const auto noise = std::make_unique<PlaneNoise>();
  ASSERT_FALSE(blocks.coords.empty());
  for (std::size_t i = 0; i < blocks.coords.size(); ++i) {
    const EdgeIndex edges(blocks.signs[i]);
    const SurfaceBlock block{blocks.coords[i], blocks.signs[i], edges};
    source.fillHermite(block, *hermite);
    source.fillNoise(block, *hermite, *noise);
    visit(*noise, *hermite, edges);
  }
}

class NoiseGridsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }

  const FloatGrid::Ptr mGrid = sphere();
};

TEST_F(NoiseGridsTest, WithoutGridsNothingIsKnown) {
  const GridSource source(mGrid);
  EXPECT_EQ(source.knowledge().noise, Noise::kNone);
}

// The gradient of a distance has length one; differences have 0.91 to 1 times the noise of values.
TEST_F(NoiseGridsTest, SigmaIsPropagatedToNormals) {
  const GridSource source(mGrid, {.sigma = companion(*mGrid, 0.2F * kVoxel)});
  EXPECT_EQ(source.knowledge().noise, Noise::kSigma);
  forEachBlock(source, [](const PlaneNoise& noise, const HermiteBlock&, const EdgeIndex& edges) {
    for (int i = 0; i < edges.size(); ++i) {
      ASSERT_NEAR(noise.sigma[i], 0.2 * 0.95, 0.2 * 0.08);
      ASSERT_EQ(noise.weight[i], 1);
    }
  });
}

TEST_F(NoiseGridsTest, ValuesAreTakenAlongTheEdge) {
  const auto weight = companion(*mGrid, 1);
  for (auto it = weight->beginValueOn(); it; ++it) it.setValue(static_cast<float>(it.getCoord().x() + 100));
  const GridSource source(mGrid, {.weight = weight});
  EXPECT_EQ(source.knowledge().noise, Noise::kWeights);
  std::size_t between = 0;
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  std::size_t block = 0;
  forEachBlock(source, [&](const PlaneNoise& noise, const HermiteBlock& hermite, const EdgeIndex& edges) {
    const int origin = 8 * blocks.coords[block++][0];
    edges.forEach([&](int i, int axis, int x, int, int) {
      const float at = static_cast<float>(origin + x + 100) + (axis == 0 ? hermite.t[i] : 0.0F);
      ASSERT_NEAR(noise.weight[i], at, 1e-4);
      ASSERT_EQ(noise.sigma[i], 0);
      between += axis == 0 && hermite.t[i] > 0.2F && hermite.t[i] < 0.8F;
    });
  });
  EXPECT_GT(between, 100u);
}

TEST_F(NoiseGridsTest, OutsideOfActiveVoxelsIsTheBackground) {
  const auto sigma = FloatGrid::create(0.3F * kVoxel);
  sigma->setTransform(mGrid->transformPtr());
  forEachBlock(GridSource(mGrid, {.sigma = sigma}),
               [](const PlaneNoise& noise, const HermiteBlock&, const EdgeIndex& edges) {
                 for (int i = 0; i < edges.size(); ++i) ASSERT_NEAR(noise.sigma[i], 0.3 * 0.95, 0.3 * 0.08);
               });
}

TEST_F(NoiseGridsTest, NegativeAndNonFiniteValuesCountAsZeroAndAreCounted) {
  const auto weight = companion(*mGrid, 1);
  int n = 0;
  for (auto it = weight->beginValueOn(); it; ++it)
    it.setValue(n++ % 2 == 0 ? -1 : std::numeric_limits<float>::quiet_NaN());
  const GridSource source(mGrid, {.weight = weight});
  EXPECT_EQ(source.refusedNoise(), static_cast<std::size_t>(n));
  forEachBlock(source, [](const PlaneNoise& noise, const HermiteBlock&, const EdgeIndex& edges) {
    for (int i = 0; i < edges.size(); ++i) ASSERT_EQ(noise.weight[i], 0);
  });
  // All crossings then count the same.
  const Mesh mesh = contour(source, {.placement = Placement::kFree}),
             plain = contour(GridSource(mGrid), {.placement = Placement::kFree});
  ASSERT_FALSE(mesh.positions.empty());
  ASSERT_EQ(mesh.positions.size(), plain.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    ASSERT_LT(length(mesh.positions[i] - plain.positions[i]), 1e-4F * kVoxel);
}

/// Expects that all σn of a grid are numbers, and the largest that is used at more than `least` crossings.
void expectLargestSigma(const GridSource& source, std::size_t least) {
  std::size_t largest = 0;
  forEachBlock(source, [&](const PlaneNoise& noise, const HermiteBlock&, const EdgeIndex& edges) {
    for (int i = 0; i < edges.size(); ++i) {
      ASSERT_TRUE(noise.sigma[i] >= 0 && noise.sigma[i] <= 10) << noise.sigma[i];
      largest += noise.sigma[i] == 10;
    }
  });
  EXPECT_GE(largest, least);
}

TEST_F(NoiseGridsTest, SigmaIsFiniteBesideClampedValues) {
  const auto one = FloatGrid::create(1);
  one->setGridClass(openvdb::GRID_LEVEL_SET);
  one->tree().setValueOn({0, 0, 0}, -0.5F);
  const GridSource source(one, {.sigma = companion(*one, 0.2F)});
  expectLargestSigma(source, 6);
  for (const Placement placement : {Placement::kFree, Placement::kCell}) {
    const Mesh mesh = contour(source, {.placement = placement, .confidence = true});
    ASSERT_FALSE(mesh.values<float>("confidence").empty());
    for (const float c : mesh.values<float>("confidence")) ASSERT_TRUE(std::isfinite(c)) << c;
  }
}

TEST_F(NoiseGridsTest, SigmaIsFiniteBesideValuesThatAreNot) {
  const auto sigma = companion(*mGrid, 0.2F * kVoxel);
  for (auto it = mGrid->beginValueOn(); it; ++it)
    if (*it > 0 && it.getCoord().x() > 0) it.setValue(std::numeric_limits<float>::infinity());
  expectLargestSigma(GridSource(mGrid, {.acceptNonFinite = true, .sigma = sigma}), 100);
}

TEST_F(NoiseGridsTest, WhatDoesNotFitIsRefused) {
  EXPECT_THROW(GridSource(mGrid, {.sigma = mGrid}), Error);
  const auto moved = companion(*mGrid, 1);
  moved->setTransform(openvdb::math::Transform::createLinearTransform(0.2));
  EXPECT_THROW(GridSource(mGrid, {.sigma = moved}), Error);
  const auto vectors = openvdb::Vec3SGrid::create();
  vectors->setTransform(mGrid->transformPtr());
  EXPECT_THROW(GridSource(mGrid, {.weight = vectors}), Error);
}

TEST_F(NoiseGridsTest, TheSameSigmaForAllIsSigmaNormal) {
  const auto sigma = companion(*mGrid, 0.2F * kVoxel);
  const Mesh own = contour(GridSource(mGrid, {.hermite = HermiteMode::kGradient, .sigma = sigma}),
                           {.sigmaNormal = 0, .placement = Placement::kFree}),
             assumed = contour(GridSource(mGrid, {.hermite = HermiteMode::kGradient}),
                               {.sigmaNormal = 0.19, .placement = Placement::kFree});
  ASSERT_FALSE(own.positions.empty());
  ASSERT_EQ(own.positions.size(), assumed.positions.size());
  for (std::size_t i = 0; i < own.positions.size(); ++i)
    ASSERT_LT(length(own.positions[i] - assumed.positions[i]), 0.1F * kVoxel);
}

// Single precision sixteen at a time, double precision one by one.
TEST_F(NoiseGridsTest, BothWaysOfSolvingAgree) {
  const auto sigma = companion(*mGrid, 1), weight = companion(*mGrid, 1);
  for (auto it = sigma->beginValueOn(); it; ++it)
    it.setValue(kVoxel * 0.1F * static_cast<float>(1 + (it.getCoord().x() & 3)));
  for (auto it = weight->beginValueOn(); it; ++it) it.setValue(static_cast<float>(1 + (it.getCoord().y() & 7)));
  const GridSource source(mGrid, {.sigma = sigma, .weight = weight});
  const Mesh lanes = contour(source, {.sigmaNormal = 0.01, .placement = Placement::kFree}),
             alone = contour(source, {.sigmaNormal = 0.0099999, .placement = Placement::kFree});
  ASSERT_FALSE(lanes.positions.empty());
  ASSERT_EQ(lanes.positions.size(), alone.positions.size());
  for (std::size_t i = 0; i < lanes.positions.size(); ++i)
    ASSERT_LT(length(lanes.positions[i] - alone.positions[i]), 2e-4F * kVoxel) << i;
}

TEST_F(NoiseGridsTest, SampledOnceIsTheSame) {
  const auto sigma = companion(*mGrid, 0.2F * kVoxel);
  const GridSource source(mGrid, {.sigma = sigma});
  const SampledSource sampled(source);
  for (const std::optional<double> s : {std::optional(0.0), std::optional(0.05), std::optional<double>()}) {
    const Mesh a = contour(source, {.sigmaNormal = s}), b = contour(sampled, {.sigmaNormal = s, .threads = 1});
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.quads, b.quads);
  }
}

/// Distances from a ball that was seen from above: what lies below, or more than 3 voxels within, has weight 0 and
/// `unseen` as value. Where `active` is false, that is not active either.
struct Scan {
  explicit Scan(float unseen, bool active) {
    values->setGridClass(openvdb::GRID_LEVEL_SET);
    for (const openvdb::Coord& c : openvdb::CoordBBox(openvdb::Coord(-16), openvdb::Coord(16))) {
      const auto distance = static_cast<float>(c.asVec3d().length()) - kScanned;
      const bool seen = c.z() >= 0 && distance > -3;
      if (seen || active) values->tree().setValueOn(c, seen ? std::min(distance, 3.0F) : unseen);
      if (seen) weights->tree().setValueOn(c, 1 + 0.1F * static_cast<float>(c.x() & 3));
    }
  }
  static constexpr float kScanned = 10;
  FloatGrid::Ptr values = FloatGrid::create(3), weights = FloatGrid::create(0);
};

TEST_F(NoiseGridsTest, TheSurfaceEndsWhereThereIsNoWeight) {
  constexpr double kHemisphere = 2 * 3.14159265358979 * Scan::kScanned * Scan::kScanned;
  for (const float unseen : {3.0F, -3.0F, 0.0F})
    for (const bool active : {true, false}) {
      const Scan scan(unseen, active);
      for (const Placement placement : {Placement::kCertified, Placement::kFree}) {
        ContourReport report;
        const GridSource source(scan.values, {.open = true, .weight = scan.weights});
        const Mesh mesh = contour(source, {.placement = placement}, &report);
        const MeshReport r = analyze(mesh);
        EXPECT_EQ(r.eulerNumber, 1);  // A disc: the border is one simple loop.
        EXPECT_EQ(r.components, 1u);
        EXPECT_GT(r.boundaryEdges, 40u);
        EXPECT_EQ(r.boundaryEdges, report.boundaryEdges);
        EXPECT_EQ(r.nonManifoldEdges, 0u);
        EXPECT_EQ(r.nonManifoldVertices, 0u);
        EXPECT_EQ(r.misorientedEdges, 0u);
        EXPECT_NEAR(r.area / kHemisphere, 1, 0.06);
        EXPECT_EQ(source.crossingsWithoutData(), 0u);
        for (const Vec3f& p : mesh.positions) ASSERT_NEAR(length(p), Scan::kScanned, 0.3);
      }
    }
}

TEST_F(NoiseGridsTest, ASurfaceThatIsClosedWithoutWeightIsCounted) {
  const Scan scan(3, true);
  const GridSource source(scan.values, {.weight = scan.weights});
  const MeshReport closed = analyze(contour(source, {.placement = Placement::kFree}));
  EXPECT_EQ(closed.boundaryEdges, 0u);
  const GridSource openSource(scan.values, {.open = true, .weight = scan.weights});
  const MeshReport open = analyze(contour(openSource, {.placement = Placement::kFree}));
  // Each crossing has a quad, and the open surface has none beyond the data.
  EXPECT_GT(source.crossingsWithoutData(), 400u);
  EXPECT_LE(source.crossingsWithoutData(), closed.quads - open.quads);
  EXPECT_GT(source.crossingsWithoutData() + 2 * open.boundaryEdges, closed.quads - open.quads);
  EXPECT_EQ(GridSource(scan.values).crossingsWithoutData(), 0u);
  EXPECT_EQ(GridSource(mGrid, {.weight = companion(*mGrid, 2)}).crossingsWithoutData(), 0u);
}

TEST_F(NoiseGridsTest, WeightsThatAreRefusedAreNoData) {
  for (const float faulty : {-1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Scan scan(3, true);
    for (auto it = scan.weights->beginValueAll(); it; ++it)
      if (*it == 0) it.setValue(faulty);
    scan.weights->tree().root().setBackground(faulty, false);
    const MeshReport r = analyze(contour(GridSource(scan.values, {.open = true, .weight = scan.weights})));
    EXPECT_EQ(r.eulerNumber, 1) << faulty;
    EXPECT_GT(r.boundaryEdges, 40u) << faulty;
  }
}

TEST_F(NoiseGridsTest, RandomHolesInTheWeightsLeaveSimpleBorders) {
  std::mt19937 engine(3);
  for (const int percent : {2, 10, 20}) {
    const auto weight = companion(*mGrid, 1);
    for (auto it = weight->beginValueOn(); it; ++it)
      if (static_cast<int>(engine() % 100) < percent) it.setValue(0);
    const MeshReport r = analyze(contour(GridSource(mGrid, {.open = true, .weight = weight})));
    EXPECT_GT(r.boundaryEdges, 0u);
    EXPECT_EQ(r.nonManifoldEdges, 0u);
    EXPECT_EQ(r.nonManifoldVertices, 0u);
    EXPECT_EQ(r.misorientedEdges, 0u);
    EXPECT_EQ(r.unusedVertices, 0u);
  }
}

TEST_F(NoiseGridsTest, WhatHasNoWeightDoesNotTellTheSide) {
  Scan scan(-3, true);
  scan.values->clearGridClass();
  scan.values->tree().root().setBackground(0, true);
  EXPECT_FALSE(GridSource(scan.values, {.weight = scan.weights}).insideIsHigher());
}

}  // namespace
}  // namespace pdc
