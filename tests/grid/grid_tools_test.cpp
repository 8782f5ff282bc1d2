// The steps against direct calls of the tools that they stand on.
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Clip.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/Filter.h>
#include <openvdb/tools/GridTransformer.h>
#include <openvdb/tools/LevelSetFilter.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <cmath>

#include "parallel/with_threads.h"
#include "pdc/grid/clip.h"
#include "pdc/grid/combine.h"
#include "pdc/grid/grid_steps.h"
#include "pdc/grid/keep_components.h"
#include "pdc/grid/offset.h"
#include "pdc/grid/resample.h"
#include "pdc/grid/smooth.h"

namespace pdc {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

constexpr float kVoxel = 0.1F;

FloatGrid::Ptr ball(double x = 0) {
  openvdb::initialize();
  return openvdb::tools::createLevelSetSphere<FloatGrid>(1.0F, {static_cast<float>(x), 0, 0}, kVoxel, 3.0F);
}

/// A ball with a bump at every voxel, so that filters have something to do.
FloatGrid::Ptr roughBall() {
  auto grid = ball();
  for (auto it = grid->beginValueOn(); it; ++it) {
    const Coord c = it.getCoord();
    it.setValue(*it + 0.02F * std::sin(static_cast<float>(7 * c.x() + 5 * c.y() + 3 * c.z())));
  }
  return grid;
}

/// A density that falls off from the middle, 24 voxels across, with an active tile in it.
FloatGrid::Ptr fog() {
  openvdb::initialize();
  auto grid = FloatGrid::create(0);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(kVoxel));
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  auto accessor = grid->getAccessor();
  for (const Coord& c : openvdb::CoordBBox(Coord(-12), Coord(11))) {
    const float value =
        1.5F - static_cast<float>(c.asVec3d().length()) / 8 + 0.1F * static_cast<float>(c.x() * c.y() % 3);
    if (value > 0) accessor.setValue(c, value);
  }
  grid->tree().addTile(1, Coord(0), 1.0F, true);
  return grid;
}

GridVolume settled(const FloatGrid::Ptr& grid) { return settleGrid(grid->deepCopy()); }

void expectSameVoxels(const openvdb::GridBase::Ptr& got, const FloatGrid& expected) {
  const auto grid = openvdb::gridPtrCast<FloatGrid>(got);
  ASSERT_NE(grid, nullptr);
  EXPECT_EQ(grid->activeVoxelCount(), expected.activeVoxelCount());
  EXPECT_EQ(grid->background(), expected.background());
  EXPECT_TRUE(grid->constTransform() == expected.constTransform());
  std::size_t different = 0;
  openvdb::CoordBBox box = expected.evalActiveVoxelBoundingBox();
  box.expand(2);
  const auto a = grid->getConstAccessor(), b = expected.getConstAccessor();
  for (const Coord& c : box) different += a.getValue(c) != b.getValue(c) || a.isValueOn(c) != b.isValueOn(c) ? 1 : 0;
  EXPECT_EQ(different, 0u);
}

TEST(GridTools, ClippingFogsAndOpenLevelSetsIsTheTools) {
  const Box box{{-0.4, -2, -0.33}, {2, 0.5, 2}};
  const openvdb::BBoxd same({-0.4, -2, -0.33}, {2, 0.5, 2});
  GridVolume dense = settled(fog()), band = settled(ball());
  GridStepReport report;
  clipGrid(dense, {.box = box}, &report);
  expectSameVoxels(dense.grid, *openvdb::tools::clip(*fog(), same));
  EXPECT_EQ(report.voxelsBefore, fog()->activeVoxelCount());
  EXPECT_EQ(report.voxelsAfter, dense.grid->activeVoxelCount());
  EXPECT_LT(report.voxelsAfter, report.voxelsBefore);
  clipGrid(band, {.box = box, .closed = false});
  expectSameVoxels(band.grid, *openvdb::tools::clip(*ball(), same));
  EXPECT_EQ(band.grid->getGridClass(), openvdb::GRID_LEVEL_SET);
}

TEST(GridTools, ClippingWithAGridIsTheTools) {
  GridVolume dense = settled(fog());
  auto mask = openvdb::BoolGrid::create(false);
  mask->setTransform(fog()->transform().copy());
  mask->fill(openvdb::CoordBBox(Coord(-5), Coord(20)), true);
  clipGrid(dense, {.mask = mask});
  auto bits = openvdb::MaskGrid::create(false);
  bits->fill(openvdb::CoordBBox(Coord(-5), Coord(20)), true);
  expectSameVoxels(dense.grid, *openvdb::tools::clip_internal::doClip(*fog(), *bits, true));
}

TEST(GridTools, ResamplingAFogIsTheTools) {
  for (const auto method : {ResampleMethod::kTrilinear, ResampleMethod::kQuadratic}) {
    GridVolume dense = settled(fog());
    resampleGrid(dense, {.voxelSize = 0.07, .method = method});
    auto expected = FloatGrid::create(0);
    expected->setTransform(openvdb::math::Transform::createLinearTransform(0.07));
    // By several threads the tool takes values of tiles beyond their borders.
    detail::withThreads(1, [&] {
      if (method == ResampleMethod::kQuadratic) {
        openvdb::tools::resampleToMatch<openvdb::tools::QuadraticSampler>(*fog(), *expected);
      } else {
        openvdb::tools::resampleToMatch<openvdb::tools::BoxSampler>(*fog(), *expected);
      }
    });
    EXPECT_NEAR(dense.grid->voxelSize()[0], 0.07, 1e-12);
    const auto grid = openvdb::gridPtrCast<FloatGrid>(dense.grid);
    const auto a = grid->getConstAccessor(), b = expected->getConstAccessor();
    double most = 0;
    for (const Coord& c : openvdb::CoordBBox(Coord(-20), Coord(20)))
      most = std::max(most, static_cast<double>(std::abs(a.getValue(c) - b.getValue(c))));
    EXPECT_LT(most, 1e-5);
  }
}

TEST(GridTools, SmoothingALevelSetIsTheTools) {
  const auto direct = [](const auto& filter) {
    auto grid = roughBall();
    openvdb::tools::LevelSetFilter<FloatGrid> tool(*grid);
    filter(tool);
    return grid;
  };
  const auto smoothed = [](SmoothFilter filter, double radius) {
    GridVolume volume = settled(roughBall());
    GridStepReport report;
    smoothGrid(volume, {.filter = filter, .radius = radius}, &report);
    EXPECT_TRUE(report.warnings.empty());
    return volume.grid;
  };
  expectSameVoxels(smoothed(SmoothFilter::kMean, 0.2), *direct([](auto& tool) { tool.mean(2); }));
  expectSameVoxels(smoothed(SmoothFilter::kGaussian, 0.1), *direct([](auto& tool) { tool.gaussian(1); }));
  expectSameVoxels(smoothed(SmoothFilter::kMedian, 0.1), *direct([](auto& tool) { tool.median(1); }));
  expectSameVoxels(smoothed(SmoothFilter::kCurvature, 0.2), *direct([](auto& tool) {
                     for (int i = 0; i < 6; ++i) tool.meanCurvature();
                   }));
}

TEST(GridTools, SmoothingAFogIsTheToolsOnWiderValues) {
  const auto direct = [](int wider, const auto& filter) {
    auto grid = fog();
    openvdb::tools::dilateActiveValues(grid->tree(), wider, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                       openvdb::tools::PRESERVE_TILES);
    openvdb::tools::Filter<FloatGrid> tool(*grid);
    tool.setProcessTiles(true);
    filter(tool);
    return grid;
  };
  const auto smoothed = [](SmoothFilter filter, double radius) {
    GridVolume volume = settled(fog());
    smoothGrid(volume, {.filter = filter, .radius = radius});
    return volume.grid;
  };
  expectSameVoxels(smoothed(SmoothFilter::kMean, 0.2), *direct(2, [](auto& tool) { tool.mean(2); }));
  expectSameVoxels(smoothed(SmoothFilter::kGaussian, 0.1), *direct(4, [](auto& tool) { tool.gaussian(1); }));
  expectSameVoxels(smoothed(SmoothFilter::kMedian, 0.1), *direct(1, [](auto& tool) { tool.median(1); }));
}

TEST(GridTools, OffsetsAreTheTools) {
  for (const float distance : {0.25F, -0.25F}) {
    GridVolume volume = settled(roughBall());
    offsetGrid(volume, distance);
    auto expected = roughBall();
    openvdb::tools::LevelSetFilter<FloatGrid>(*expected).offset(-distance);
    expectSameVoxels(volume.grid, *expected);
  }
}

TEST(GridTools, CombiningOnOneLatticeIsTheTools) {
  const auto combined = [](CombineKind kind) {
    GridVolume volume = settled(ball());
    combineGrids(volume, kind, settled(ball(0.7)));
    return volume.grid;
  };
  const auto all = ball(), both = ball(), rest = ball();
  openvdb::tools::csgUnion(*all, *ball(0.7));
  openvdb::tools::csgIntersection(*both, *ball(0.7));
  openvdb::tools::csgDifference(*rest, *ball(0.7));
  expectSameVoxels(combined(CombineKind::kUnion), *all);
  expectSameVoxels(combined(CombineKind::kIntersect), *both);
  expectSameVoxels(combined(CombineKind::kSubtract), *rest);
}

/// The steps that the bits of a number choose, by direct calls.
FloatGrid::Ptr combinedDirectly(unsigned bits, const openvdb::BBoxd& box) {
  auto grid = roughBall();
  if ((bits & 1) != 0) {
    grid = openvdb::tools::clip(*grid, box);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
  }
  openvdb::tools::LevelSetFilter<FloatGrid> filter(*grid);
  if ((bits & 2) != 0) filter.gaussian(1);
  if ((bits & 4) != 0) filter.mean(1);
  if ((bits & 8) != 0) filter.offset(-0.15F);
  if ((bits & 16) != 0) openvdb::tools::csgUnion(*grid, *ball(0.7));
  if ((bits & 32) != 0) openvdb::tools::csgDifference(*grid, *ball(-0.7));
  return grid;
}

TEST(GridTools, TenCombinationsAreTheToolsOneAfterTheOther) {
  const Box box{{-0.4, -2, -0.33}, {2, 0.5, 2}};
  // Clipping, one of two filters, an offset, a union, a difference.
  for (const unsigned bits : {3U, 5U, 9U, 10U, 12U, 18U, 24U, 27U, 44U, 59U}) {
    SCOPED_TRACE(bits);
    GridVolume volume = settled(roughBall());
    GridSteps steps;
    if ((bits & 1) != 0) steps.clip = ClipOptions{.box = box, .closed = false};
    if ((bits & 6) != 0)
      steps.smooth =
          SmoothGridOptions{.filter = (bits & 2) != 0 ? SmoothFilter::kGaussian : SmoothFilter::kMean, .radius = 0.1};
    if ((bits & 8) != 0) steps.offset = 0.15;
    if ((bits & 16) != 0)
      steps.combine.push_back({.kind = CombineKind::kUnion, .other = settled(ball(0.7)), .name = "right"});
    if ((bits & 32) != 0)
      steps.combine.push_back({.kind = CombineKind::kSubtract, .other = settled(ball(-0.7)), .name = "left"});
    applyGridSteps(volume, steps);
    expectSameVoxels(volume.grid, *combinedDirectly(bits, {{-0.4, -2, -0.33}, {2, 0.5, 2}}));
  }
}

TEST(KeepComponents, LeavesDenseSurfacesAlone) {
  // A ball full of a gyroid, whose voxels are all active and near to both sides, and a speck.
  openvdb::initialize();
  auto grid = FloatGrid::create(3 * kVoxel);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(kVoxel));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  for (const Coord& c : openvdb::CoordBBox(Coord(-20), Coord(22))) {
    const openvdb::Vec3d p = c.asVec3d() * 0.5;
    const double gyroid = 1.5 * (std::sin(p.x()) * std::cos(p.y()) + std::sin(p.y()) * std::cos(p.z()) +
                                 std::sin(p.z()) * std::cos(p.x()));
    const double solid = std::max(gyroid, c.asVec3d().length() - 16);
    const double d = std::min(solid, (c.asVec3d() - openvdb::Vec3d(18)).length() - 1.5);
    if (std::abs(d) < 3) grid->tree().setValue(c, static_cast<float>(d * kVoxel));
  }
  openvdb::tools::signedFloodFill(grid->tree());
  GridVolume volume = settleGrid(grid->deepCopy());
  ASSERT_TRUE(volume.distances);
  GridStepReport report;
  keepComponents(volume, {.most = 1}, &report);
  EXPECT_GT(report.partsBefore, 1u);
  const auto kept = openvdb::gridPtrCast<FloatGrid>(volume.grid);
  std::size_t different = 0;
  for (const Coord& c : openvdb::CoordBBox(Coord(-8), Coord(8)))
    different += kept->tree().getValue(c) != grid->tree().getValue(c) ? 1 : 0;
  EXPECT_EQ(different, 0u);
  EXPECT_GT(kept->tree().getValue(Coord(18)), 0);
}

}  // namespace
}  // namespace pdc
