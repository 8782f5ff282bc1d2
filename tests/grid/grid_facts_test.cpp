// What must be true of the grids that come out of the steps.
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/grid/fill_cavities.h"
#include "pdc/grid/fog_to_level_set.h"
#include "pdc/grid/grid_steps.h"
#include "pdc/grid/mesh_to_level_set.h"
#include "pdc/grid/offset.h"
#include "pdc/grid/open_close.h"
#include "pdc/io/vdb/vdb_writer.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

using openvdb::Coord;
using openvdb::DoubleGrid;
using openvdb::FloatGrid;

constexpr double kPi = 3.14159265358979323846;
constexpr float kVoxel = 0.05F;

template <typename GridT = FloatGrid>
typename GridT::Ptr ball(double radius = 0.5, const openvdb::Vec3f& center = {0, 0, 0}) {
  openvdb::initialize();
  return openvdb::tools::createLevelSetSphere<GridT>(static_cast<float>(radius), center, kVoxel, 3.0F);
}

constexpr double kHalfEdge = 0.49;

/// The distance to a cube about the origin.
double cubeDistance(const openvdb::Vec3d& p) {
  const openvdb::Vec3d q(std::abs(p.x()) - kHalfEdge, std::abs(p.y()) - kHalfEdge, std::abs(p.z()) - kHalfEdge);
  const openvdb::Vec3d out(std::max(q.x(), 0.0), std::max(q.y(), 0.0), std::max(q.z(), 0.0));
  return out.length() + std::min(std::max({q.x(), q.y(), q.z()}), 0.0);
}

FloatGrid::Ptr cube() {
  openvdb::initialize();
  auto grid = FloatGrid::create(3 * kVoxel);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(kVoxel));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto accessor = grid->getAccessor();
  for (const Coord& c : openvdb::CoordBBox(Coord(-15), Coord(15)))
    if (const double d = cubeDistance(grid->indexToWorld(c)); std::abs(d) < 3 * kVoxel)
      accessor.setValue(c, static_cast<float>(d));
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

Mesh meshOf(const GridVolume& volume) {
  return contour(GridSource(volume.grid, {.iso = volume.iso, .gridClass = volume.gridClass, .inside = volume.inside}));
}
MeshReport reportOf(const GridVolume& volume) { return analyze(meshOf(volume)); }

/// The largest |values - distance| over the active voxels of a level set nearer than two voxels to the surface.
template <typename Distance>
double largestError(const GridVolume& volume, const Distance& distance) {
  const auto grid = openvdb::gridPtrCast<FloatGrid>(volume.grid);
  double most = 0;
  for (auto it = grid->cbeginValueOn(); it; ++it) {
    if (std::abs(*it) > 2 * grid->voxelSize()[0]) continue;
    most = std::max(most, std::abs(static_cast<double>(*it) - distance(grid->indexToWorld(it.getCoord()))));
  }
  return most;
}

std::string messageOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(GridFacts, ABoxClosesWhatItCutsWithFlatFaces) {
  GridVolume volume = settleGrid(ball());
  // The plane lies between voxels.
  clipGrid(volume, {.box = {{-9, -9, 0.0123}, {9, 9, 9}}});
  const MeshReport report = reportOf(volume);
  EXPECT_EQ(report.boundaryEdges, 0u);
  EXPECT_EQ(report.eulerNumber, 2);
  EXPECT_NEAR(report.bounds.lo.z, 0.0123, 0.02 * kVoxel);
  const double h = 0.5 - 0.0123;
  EXPECT_NEAR(report.volume, kPi * h * h * (3 * 0.5 - h) / 3, 0.003);
  EXPECT_TRUE(volume.distances);
  GridVolume open = settleGrid(ball());
  clipGrid(open, {.box = {{-9, -9, 0.0123}, {9, 9, 9}}, .closed = false});
  const Mesh shell = contour(GridSource(open.grid, {.open = true, .gridClass = GridClass::kLevelSet}));
  EXPECT_GT(analyze(shell).boundaryEdges, 50u);
}

TEST(GridFacts, ABoxBesideTheSolidLeavesNothingAndSaysSo) {
  GridVolume volume = settleGrid(ball());
  GridStepReport report;
  clipGrid(volume, {.box = {{3, 3, 3}, {4, 4, 4}}}, &report);
  EXPECT_EQ(report.voxelsAfter, 0u);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("nothing is left"), std::string::npos);
  // What follows has nothing to do, and does no harm.
  GridSteps rest{
      .resample = ResampleOptions{.voxelSize = 0.03}, .smooth = SmoothGridOptions{.radius = 0.1}, .offset = 0.1};
  rest.openClose = 0.1;
  rest.keep = KeepOptions{.most = 1};
  rest.fillCavities = true;
  applyGridSteps(volume, rest);
  EXPECT_TRUE(meshOf(volume).empty());
}

TEST(GridFacts, ResamplingALevelSetKeepsCreases) {
  for (const double voxel : {0.031, 0.08}) {
    GridVolume best = settleGrid(cube()), linear = settleGrid(cube());
    ASSERT_TRUE(best.distances);
    resampleGrid(best, {.voxelSize = voxel});
    resampleGrid(linear, {.voxelSize = voxel, .method = ResampleMethod::kTrilinear});
    EXPECT_NEAR(best.grid->voxelSize()[0], voxel, 1e-12);
    EXPECT_LT(largestError(best, cubeDistance), 0.05 * kVoxel) << voxel;
    EXPECT_GT(largestError(linear, cubeDistance), 0.1 * kVoxel) << voxel;
    EXPECT_NEAR(reportOf(best).volume, 8 * kHalfEdge * kHalfEdge * kHalfEdge, 3e-3);
  }
}

TEST(GridFacts, ResamplingMakesCubesOfOtherVoxels) {
  auto grid = ball();
  grid->setTransform(openvdb::math::Transform::createLinearTransform(
      openvdb::Mat4d(0.05, 0., 0., 0., 0.02, 0.05, 0., 0., 0., 0., -0.1, 0., 0., 0., 0., 1.)));
  GridVolume volume = settleGrid(grid);
  EXPECT_FALSE(volume.distances);
  const double before = reportOf(volume).volume;
  EXPECT_NE(messageOf([&] { offsetGrid(volume, 0.1); }).find("--resample makes them so"), std::string::npos);
  EXPECT_NE(messageOf([&] { smoothGrid(volume, {.radius = 0.1}); }).find("cubes"), std::string::npos);
  resampleGrid(volume, {.voxelSize = 0.04});
  EXPECT_TRUE(volume.grid->hasUniformVoxels());
  EXPECT_GT(before, 0.5);
  EXPECT_NEAR(reportOf(volume).volume, before, 0.01 * before);
  offsetGrid(volume, 0.1);
  EXPECT_GT(reportOf(volume).volume, 1.2 * before);
}

TEST(GridFacts, MirroredAndTurnedLatticesAreRight) {
  for (const bool mirrored : {false, true}) {
    auto grid = ball();
    openvdb::Mat4d matrix(openvdb::Mat4d::identity());
    matrix.preRotate(openvdb::math::Z_AXIS, 0.3);
    matrix.preScale(openvdb::Vec3d(mirrored ? -kVoxel : kVoxel, kVoxel, kVoxel));
    grid->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
    GridVolume volume = settleGrid(grid);
    ASSERT_TRUE(volume.distances) << mirrored;
    GridSteps steps{.clip = ClipOptions{.box = {{-9, -9, 0}, {9, 9, 9}}},
                    .resample = ResampleOptions{.voxelSize = 0.04},
                    .smooth = SmoothGridOptions{.filter = SmoothFilter::kMean, .radius = 0.05},
                    .offset = 0.1};
    applyGridSteps(volume, steps);
    const MeshReport report = reportOf(volume);
    EXPECT_NEAR(report.bounds.hi.x, 0.6, 0.01);
    EXPECT_NEAR(report.bounds.hi.z, 0.6, 0.01);
    EXPECT_NEAR(report.bounds.lo.z, -0.1, 0.01);
    EXPECT_GT(report.volume, 0);
  }
}

TEST(GridFacts, OffsetsMoveTheSurface) {
  const auto grown = [](double distance) {
    return [distance](const openvdb::Vec3d& p) { return p.length() - 0.5 - distance; };
  };
  for (const double distance : {0.33, -0.21}) {
    GridVolume volume = settleGrid(ball());
    offsetGrid(volume, distance);
    EXPECT_LT(largestError(volume, grown(distance)), 0.1 * kVoxel);
  }
  GridVolume volume = settleGrid(ball<DoubleGrid>());
  offsetGrid(volume, 0.1);
  EXPECT_TRUE(volume.grid->isType<DoubleGrid>());
  EXPECT_NEAR(reportOf(volume).bounds.hi.y, 0.6, 0.003);
  EXPECT_NE(messageOf([&] { offsetGrid(volume, 100); }).find("at most 128"), std::string::npos);
}

TEST(GridFacts, OpeningAndClosingRemoveWhatIsThin) {
  // Two balls, one of which is too small to stay, and a large one with a cavity too small to stay.
  auto grid = ball(0.5);
  openvdb::tools::csgUnion(*grid, *ball(0.12, {1.2F, 0, 0}));
  openvdb::tools::csgDifference(*grid, *ball(0.1));
  GridVolume volume = settleGrid(grid);
  ASSERT_EQ(reportOf(volume).components, 3u);
  openCloseGrid(volume, 0.15);
  const MeshReport report = reportOf(volume);
  EXPECT_EQ(report.components, 1u);
  EXPECT_NEAR(report.volume, 4.0 / 3 * kPi * 0.125, 0.01);
}

TEST(GridFacts, LatticesAndTypesMayDifferInCombinations) {
  auto other = openvdb::tools::createLevelSetSphere<DoubleGrid>(0.5F, {0.6F, 0, 0}, 0.031F, 4.0F);
  openvdb::Mat4d matrix = openvdb::Mat4d::identity();
  matrix.preRotate(openvdb::math::X_AXIS, 0.4);
  matrix.preScale(openvdb::Vec3d(0.031));
  other->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
  const double d = 0.6, r = 0.5, lens = kPi * (4 * r + d) * (2 * r - d) * (2 * r - d) / 12;
  const double whole = 4.0 / 3 * kPi * r * r * r;
  const auto volumeOf = [&](CombineKind kind) {
    GridVolume volume = settleGrid(ball());
    combineGrids(volume, kind, settleGrid(other->deepCopy()));
    EXPECT_TRUE(volume.grid->isType<FloatGrid>());
    return reportOf(volume).volume;
  };
  EXPECT_NEAR(volumeOf(CombineKind::kUnion), 2 * whole - lens, 0.005);
  EXPECT_NEAR(volumeOf(CombineKind::kIntersect), lens, 0.005);
  EXPECT_NEAR(volumeOf(CombineKind::kSubtract), whole - lens, 0.005);
}

/// Three balls of different sizes, the middle one hollow.
FloatGrid::Ptr threeBalls() {
  auto grid = ball(0.3, {-1.3F, 0, 0});
  openvdb::tools::csgUnion(*grid, *ball(0.5));
  openvdb::tools::csgUnion(*grid, *ball(0.2, {1.3F, 0, 0}));
  openvdb::tools::csgDifference(*grid, *ball(0.15));
  return grid;
}

GridVolume threeBallsOf(bool asFog) {
  auto grid = threeBalls();
  if (asFog) {
    openvdb::tools::sdfToFogVolume(*grid);
    return settleGrid(grid, {.meaning = {.iso = 0.4}});
  }
  return settleGrid(grid);
}

TEST(GridFacts, PartsAreKeptAndCavitiesFilledInAllVolumes) {
  for (const bool asFog : {false, true}) {
    GridVolume volume = threeBallsOf(asFog);
    ASSERT_EQ(reportOf(volume).components, 4u);
    GridStepReport kept, filled;
    keepComponents(volume, {.most = 2}, &kept);
    EXPECT_EQ(kept.partsBefore, 3u);
    EXPECT_EQ(kept.partsAfter, 2u);
    EXPECT_EQ(reportOf(volume).components, 3u);
    EXPECT_LT(reportOf(volume).bounds.hi.x, 0.6);
    fillCavities(volume, &filled);
    EXPECT_EQ(filled.partsBefore, 1u);
    EXPECT_EQ(reportOf(volume).components, 2u);
    keepComponents(volume, {.most = 1}, &kept);
    const MeshReport report = reportOf(volume);
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.eulerNumber, 2);
    EXPECT_GT(report.bounds.lo.x, -0.6);
    keepComponents(volume, {.moreVoxelsThan = 1000000}, &kept);
    ASSERT_FALSE(kept.warnings.empty());
    EXPECT_TRUE(meshOf(volume).empty());
  }
}

TEST(GridFacts, WhatIsLeftOfALevelSetHasItsDistances) {
  GridVolume volume = threeBallsOf(false);
  keepComponents(volume, {.most = 1});
  fillCavities(volume);
  EXPECT_LT(largestError(volume, [](const openvdb::Vec3d& p) { return p.length() - 0.5; }), 1e-6);
  // Few voxels tell any longer of what went: beyond the band, where distances to both are alike.
  const double all = static_cast<double>(settleGrid(ball()).grid->activeVoxelCount());
  EXPECT_GE(static_cast<double>(volume.grid->activeVoxelCount()), all);
  EXPECT_LT(static_cast<double>(volume.grid->activeVoxelCount()), 1.05 * all);
  offsetGrid(volume, 0.3);
  EXPECT_EQ(reportOf(volume).components, 1u);
}

TEST(GridFacts, FogsBecomeLevelSets) {
  auto grid = ball();
  openvdb::tools::sdfToFogVolume(*grid);
  GridVolume volume = settleGrid(grid, {.meaning = {.iso = 0.5}});
  GridStepReport report;
  fogToLevelSet(volume, 0.5, &report);
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_EQ(volume.grid->getGridClass(), openvdb::GRID_LEVEL_SET);
  // The fog is 0.5 where the level set was halfway into its band.
  const double radius = 0.5 - 1.5 * kVoxel;
  EXPECT_LT(largestError(volume, [&](const openvdb::Vec3d& p) { return p.length() - radius; }), 0.1 * kVoxel);
  EXPECT_NE(messageOf([&] { fogToLevelSet(volume, 0.5); }), "");
}

TEST(GridFacts, MeshesBecomeLevelSets) {
  const Mesh mesh = meshOf(settleGrid(cube()));
  GridStepReport report;
  GridVolume volume = meshToLevelSet(mesh, {.voxelSize = 0.04, .halfWidth = 0.2}, &report);
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_NEAR(openvdb::gridPtrCast<FloatGrid>(volume.grid)->background(), 0.2, 1e-6);
  EXPECT_NEAR(reportOf(volume).volume, 8 * kHalfEdge * kHalfEdge * kHalfEdge, 3e-3);
  Mesh open = mesh;
  open.quads.resize(open.quads.size() - 100);
  static_cast<void>(meshToLevelSet(open, {.voxelSize = 0.04}, &report));
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("boundary edges"), std::string::npos);
}

TEST(GridFacts, WhatIsNoDistanceIsMadeOne) {
  // Values in voxels instead of world units, of a band of one voxel, positive inside.
  auto scaled = ball();
  for (auto it = scaled->beginValueAll(); it; ++it) it.setValue(*it / kVoxel);
  scaled->tree().root().setBackground(3, false);
  auto narrow = openvdb::tools::createLevelSetSphere<FloatGrid>(0.5F, {0, 0, 0}, kVoxel, 1.5F);
  auto inverted = ball();
  for (auto it = inverted->beginValueAll(); it; ++it) it.setValue(-*it);
  inverted->tree().root().setBackground(-3 * kVoxel, false);
  for (const auto& grid : {scaled, narrow, inverted}) {
    GridVolume volume = settleGrid(grid);
    EXPECT_EQ(volume.distances, grid == inverted);
    GridStepReport report;
    offsetGrid(volume, 0.1, &report);
    EXPECT_EQ(report.warnings.size(), grid == inverted ? 0u : 1u);
    EXPECT_NEAR(reportOf(volume).bounds.hi.x, 0.6, 0.1 * kVoxel);
  }
}

TEST(GridFacts, TypesAndValuesThatCannotBeAreRefused) {
  openvdb::initialize();
  EXPECT_NE(messageOf([] { static_cast<void>(settleGrid(openvdb::Int32Grid::create(0))); }).find("type int32"),
            std::string::npos);
  auto grid = ball();
  grid->tree().setValue(Coord(10, 0, 0), std::numeric_limits<float>::quiet_NaN());
  EXPECT_NE(messageOf([&] { static_cast<void>(settleGrid(grid)); }).find("1 values are NaN"), std::string::npos);
  const GridVolume volume = settleGrid(grid, {.acceptNonFinite = true});
  EXPECT_EQ(openvdb::gridPtrCast<FloatGrid>(volume.grid)->tree().getValue(Coord(10, 0, 0)), 3 * kVoxel);
  GridVolume fine = settleGrid(ball());
  EXPECT_NE(messageOf([&] { resampleGrid(fine, {.voxelSize = 1e-9}); }), "");
  EXPECT_NE(messageOf([&] { smoothGrid(fine, {.radius = 0.01}); }).find("half a voxel"), std::string::npos);
  GridVolume dense = threeBallsOf(true);
  EXPECT_NE(messageOf([&] { offsetGrid(dense, 0.1); }).find("--fog-to-level-set"), std::string::npos);
}

std::string bytesAfterAllSteps(int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  GridVolume volume = settleGrid(threeBalls());
  GridSteps steps{.clip = ClipOptions{.box = {{-9, -0.4, -9}, {1.3, 9, 9}}},
                  .resample = ResampleOptions{.voxelSize = 0.04},
                  .smooth = SmoothGridOptions{.filter = SmoothFilter::kGaussian, .radius = 0.04},
                  .offset = 0.05,
                  .openClose = 0.1};
  steps.combine.push_back({.kind = CombineKind::kSubtract, .other = settleGrid(ball(0.3, {0, 0, 0.5F})), .name = "b"});
  steps.keep = KeepOptions{.most = 2};
  steps.fillCavities = true;
  std::vector<GridStepReport> reports;
  applyGridSteps(volume, steps, &reports);
  EXPECT_EQ(reports.size(), 8u);
  const auto path = std::filesystem::temp_directory_path() / ("pdc_steps_" + std::to_string(threads) + ".vdb");
  writeVdb(volume.grid, path);
  std::stringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  std::filesystem::remove(path);
  return bytes.str();
}

TEST(GridFacts, BytesDoNotDependOnThreads) {
  const std::string one = bytesAfterAllSteps(1);
  EXPECT_GT(one.size(), 10000u);
  EXPECT_EQ(one, bytesAfterAllSteps(2));
  EXPECT_EQ(one, bytesAfterAllSteps(7));
}

TEST(GridFacts, StepsCanBeWatchedAndStopped) {
  std::atomic<bool> stop = false;
  std::atomic<int> calls = 0;
  const Monitor monitor{.progress =
                            [&](const char*, double share) {
                              EXPECT_GE(share, 0);
                              EXPECT_LE(share, 1);
                              if (++calls == 5) stop = true;
                            },
                        .stop = &stop};
  GridVolume volume = settleGrid(ball());
  EXPECT_THROW(offsetGrid(volume, 0.3, nullptr, monitor), Cancelled);
  EXPECT_LT(calls, 12);
  for (const SmoothFilter filter : {SmoothFilter::kMean, SmoothFilter::kMedian, SmoothFilter::kCurvature}) {
    GridVolume other = settleGrid(ball());
    EXPECT_THROW(smoothGrid(other, {.filter = filter, .radius = 0.1}, nullptr, monitor), Cancelled);
  }
  EXPECT_THROW(resampleGrid(volume, {.voxelSize = 0.03}, nullptr, monitor), Cancelled);
}

}  // namespace
}  // namespace pdc
