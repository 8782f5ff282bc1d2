// Clipping, resampling, smoothing and keeping the largest part, then the contour: by the steps, and by direct calls of
// OpenVDB's tools; seconds, the best of some rounds in turn, and memory. Usage: grid_bench [FILE.vdb …]
#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetFilter.h>
#include <openvdb/tools/LevelSetRebuild.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "pdc/extract/contour.h"
#include "pdc/grid/grid_steps.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/sample/vdb/grid_source.h"

namespace {

using namespace pdc;
using openvdb::FloatGrid;

constexpr int kRounds = 5;

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Half of the grid's box, in world units.
openvdb::BBoxd halfBox(const FloatGrid& grid) {
  const openvdb::CoordBBox active = grid.evalActiveVoxelBoundingBox();
  openvdb::Vec3d lo = grid.indexToWorld(active.min()), hi = grid.indexToWorld(active.max());
  lo.x() = (lo.x() + hi.x()) / 2;
  return {lo - grid.voxelSize(), hi + grid.voxelSize()};
}

struct Times {
  double clip = 1e9, resample = 1e9, smooth = 1e9, keep = 1e9, contour = 1e9;
  [[nodiscard]] double sum() const { return clip + resample + smooth + keep + contour; }
};

void keepBest(double& best, double time) { best = std::min(best, time); }

void runDirectly(const FloatGrid& input, double voxel, Times& times) {
  FloatGrid::Ptr grid = input.deepCopy();
  keepBest(times.clip, seconds([&] {
             const auto box = openvdb::tools::createLevelSetBox<FloatGrid>(halfBox(input), input.transform());
             openvdb::tools::csgIntersection(*grid, *box);
           }));
  keepBest(times.resample, seconds([&] {
             const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
             grid = openvdb::tools::levelSetRebuild(*grid, 0.0F, 3.0F, 3.0F, transform.get());
           }));
  keepBest(times.smooth, seconds([&] { openvdb::tools::LevelSetFilter<FloatGrid>(*grid).gaussian(1); }));
  keepBest(times.keep, seconds([&] {
             std::vector<FloatGrid::Ptr> parts;
             openvdb::tools::segmentSDF(*grid, parts);
             grid = parts.front();
           }));
  keepBest(times.contour, seconds([&] { static_cast<void>(contour(GridSource(grid))); }));
}

void runSteps(const FloatGrid& input, double voxel, Times& times) {
  GridVolume volume = settleGrid(input.deepCopy());
  const openvdb::BBoxd half = halfBox(input);
  const auto from = [](const openvdb::Vec3d& v) { return Vec3d{v.x(), v.y(), v.z()}; };
  keepBest(times.clip, seconds([&] { clipGrid(volume, {.box = {from(half.min()), from(half.max())}}); }));
  keepBest(times.resample, seconds([&] { resampleGrid(volume, {.voxelSize = voxel}); }));
  keepBest(times.smooth, seconds([&] { smoothGrid(volume, {.filter = SmoothFilter::kGaussian, .radius = voxel}); }));
  keepBest(times.keep, seconds([&] { keepComponents(volume, {.most = 1}); }));
  keepBest(times.contour, seconds([&] { static_cast<void>(contour(GridSource(volume.grid))); }));
}

void compare(const std::string& name, const FloatGrid& grid) {
  const double voxel = 1.25 * grid.voxelSize()[0];
  Times direct, steps;
  for (int round = 0; round < kRounds; ++round) {
    runDirectly(grid, voxel, direct);
    runSteps(grid, voxel, steps);
  }
  const auto row = [&](const char* who, const Times& t) {
    fmt::print("| {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", name, who, t.clip, t.resample,
               t.smooth, t.keep, t.contour, t.sum());
  };
  row("tools", direct);
  row("steps", steps);
  fmt::print("{}: {} voxels, {:.1f} MB; steps / tools {:.3f}\n", name, grid.activeVoxelCount(),
             static_cast<double>(grid.memUsage()) / 1e6, steps.sum() / direct.sum());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  openvdb::initialize();
  fmt::print("| input | by | clip | resample | smooth | keep | contour | all |\n|---|---|---|---|---|---|---|---|\n");
  compare("ball", *openvdb::tools::createLevelSetSphere<FloatGrid>(1.0F, {0, 0, 0}, 0.01F, 3.0F));
  for (int i = 1; i < argc; ++i)
    if (const auto grid = openvdb::gridPtrCast<FloatGrid>(readVdbGrid(argv[i]))) compare(argv[i], *grid);
}
