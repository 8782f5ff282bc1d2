// What must be true of grids that are interpolated on another lattice, and what is refused before it is tried.
#include "pdc/grid/resample.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <tbb/global_control.h>

#include <cstddef>
#include <functional>
#include <numbers>
#include <string>

#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/grid/offset.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;

/// So large that the middle of the ball is stored in tiles.
FloatGrid::Ptr ball() {
  openvdb::initialize();
  return openvdb::tools::createLevelSetSphere<FloatGrid>(1.0F, {0, 0, 0}, 0.04F, 3.0F);
}

/// A fog whose inside is inactive: leaves and tiles of 1 in a background of 0, in many places.
FloatGrid::Ptr inactiveFog() {
  openvdb::initialize();
  auto grid = FloatGrid::create(0);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  for (int i = 0; i < 40; ++i) {
    const Coord at(40 * i, 24 * (i % 3), 0);
    grid->denseFill(CoordBBox(at, at.offsetBy(15)), 1.0F, false);
    grid->tree().setValue(at, 1.0F);
  }
  return grid;
}

Mesh meshOf(const GridVolume& volume) {
  return contour(GridSource(volume.grid, {.iso = volume.iso, .gridClass = volume.gridClass, .inside = volume.inside}));
}

std::string refusalOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Resample, InterpolatedLevelSetsStaySolid) {
  for (const auto method : {ResampleMethod::kTrilinear, ResampleMethod::kQuadratic})
    for (const double voxel : {0.03, 0.06}) {
      GridVolume volume = settleGrid(ball());
      ASSERT_TRUE(openvdb::gridPtrCast<FloatGrid>(volume.grid)->tree().getValueDepth(Coord(0)) < 3);
      resampleGrid(volume, {.voxelSize = voxel, .method = method});
      EXPECT_LT(openvdb::gridPtrCast<FloatGrid>(volume.grid)->tree().getValue(Coord(0)), 0.0F);
      const MeshReport report = analyze(meshOf(volume));
      EXPECT_NEAR(report.volume, 4 * std::numbers::pi / 3, 0.02);
      EXPECT_EQ(report.components, 1u);
      EXPECT_EQ(report.boundaryEdges, 0u);
    }
}

TEST(Resample, ActiveTilesOfALevelSetAreInterpolatedToo) {
  auto grid = ball();
  grid->tree().addTile(1, Coord(0), grid->tree().getValue(Coord(0)), true);
  GridVolume volume = settleGrid(grid);
  resampleGrid(volume, {.voxelSize = 0.06, .method = ResampleMethod::kTrilinear});
  EXPECT_NEAR(analyze(meshOf(volume)).volume, 4 * std::numbers::pi / 3, 0.02);
}

TEST(Resample, InactiveValuesOfAFogStayWithAnyNumberOfThreads) {
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    GridVolume volume = settleGrid(inactiveFog(), {.meaning = {.iso = 0.5, .gridClass = GridClass::kFogVolume}});
    resampleGrid(volume, {.voxelSize = 0.8});
    const MeshReport report = analyze(meshOf(volume));
    EXPECT_EQ(report.components, 40u) << threads;
    EXPECT_NEAR(report.volume, 40 * 16 * 16 * 16, 40 * 100) << threads;
  }
}

TEST(Resample, TilesThatWouldFillTheMemoryAreRefusedWithBothFigures) {
  auto grid = inactiveFog();
  for (int i = 0; i < 40; ++i) grid->tree().addTile(3, Coord(4096 * (i + 1), 0, 0), 1.0F, false);
  GridVolume volume = settleGrid(grid, {.meaning = {.iso = 0.5, .gridClass = GridClass::kFogVolume}});
  const std::string refusal = refusalOf([&] { resampleGrid(volume, {.voxelSize = 0.5}); });
  // 40 tiles of 4096³ voxels, eight for each.
  EXPECT_NE(refusal.find("2.2e+13 voxels"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("GB are left"), std::string::npos) << refusal;
}

TEST(Resample, ContoursThatWouldFillTheMemoryAreRefusedWithBothFigures) {
  auto grid = ball();
  for (int i = 0; i < 200; ++i) grid->tree().addTile(3, Coord(4096 * (2 * i + 1), 0, 0), -1.0F, false);
  GridVolume volume = settleGrid(grid, {.meaning = {.gridClass = GridClass::kLevelSet}});
  // Values of one that have no band about them are no distances, and are made so first.
  volume.distances = false;
  const std::string refusal = refusalOf([&] { offsetGrid(volume, 0.1); });
  EXPECT_NE(refusal.find("20.1 billion vertices"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("that the machine has"), std::string::npos) << refusal;
}

}  // namespace
}  // namespace pdc
