#include "sample/vdb/noise_grids.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <limits>
#include <memory>

#include "pdc/extract/contour.h"
#include "pdc/sample/sampled_source.h"

namespace pdc {
namespace {

using openvdb::FloatGrid;
using Noise = SourceKnowledge::Noise;

constexpr float kVoxel = 0.1F;

FloatGrid::Ptr sphere() { return openvdb::tools::createLevelSetSphere<FloatGrid>(1.5F, {0, 0, 0}, kVoxel); }

/// With the sphere's transform and active voxels.
FloatGrid::Ptr companion(const FloatGrid& grid, float value) {
  auto out = FloatGrid::create(value);
  out->setTransform(grid.transform().copy());
  for (auto it = grid.cbeginValueOn(); it; ++it) out->tree().setValue(it.getCoord(), value);
  return out;
}

class NoiseGridsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }

  /// Calls visit(noise, hermite, edges) for each block.
  template <typename Visit>
  static void forEachBlock(const GridSource& source, Visit&& visit) {
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

  const FloatGrid::Ptr mGrid = sphere();
};

TEST_F(NoiseGridsTest, WithoutGridsNothingIsKnown) {
  const GridSource source(mGrid);
  EXPECT_EQ(source.knowledge().noise, Noise::kNone);
}

// Of a distance, whose gradient has length one; the factor is that of differences, 0.91 to 1.
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
  ASSERT_EQ(mesh.positions.size(), plain.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    ASSERT_LT(length(mesh.positions[i] - plain.positions[i]), 1e-4F * kVoxel);
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

}  // namespace
}  // namespace pdc
