// What each step on grids does to creases, places, volume and noise: the table of docs/grids.md. One voxel is one world
// unit; the solids are 40 voxels across.
#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetRebuild.h>

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "eval/inputs.h"
#include "eval/metrics.h"
#include "eval/shapes.h"
#include "pdc/extract/contour.h"
#include "pdc/grid/clip.h"
#include "pdc/grid/combine.h"
#include "pdc/grid/fill_cavities.h"
#include "pdc/grid/keep_components.h"
#include "pdc/grid/mesh_to_level_set.h"
#include "pdc/grid/offset.h"
#include "pdc/grid/open_close.h"
#include "pdc/grid/resample.h"
#include "pdc/grid/smooth.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/vdb/grid_source.h"

namespace {

using namespace pdc;

constexpr double kSize = 20, kNoise = 0.15;

struct Step {
  std::string name;
  std::function<void(GridVolume&)> run;
};

Mesh meshOf(const GridVolume& volume) {
  return contour(GridSource(volume.grid, {.iso = volume.iso, .gridClass = volume.gridClass, .inside = volume.inside}));
}

Step resample(const char* name, double voxelSize, ResampleMethod method) {
  return {name, [=](GridVolume& v) { resampleGrid(v, {.voxelSize = voxelSize, .method = method}); }};
}

Step smooth(const char* name, SmoothFilter filter, double radius) {
  return {name, [=](GridVolume& v) { smoothGrid(v, {.filter = filter, .radius = radius}); }};
}

void rebuild(GridVolume& volume, double voxelSize) {
  const auto transform = openvdb::math::Transform::createLinearTransform(voxelSize);
  volume.grid =
      openvdb::tools::levelSetRebuild(*openvdb::gridPtrCast<openvdb::FloatGrid>(volume.grid), 0, 3, transform.get());
}

std::vector<Step> allSteps() {
  return {
      {"none", [](GridVolume&) {}},
      {"mesh, mesh-to-level-set 1", [](GridVolume& v) { v = meshToLevelSet(meshOf(v), {.voxelSize = 1}); }},
      {"clip, a box around it",
       [](GridVolume& v) {
         clipGrid(v, {.box = {{-50, -50, -50}, {50, 50, 50}}});
       }},
      resample("resample 0.7", 0.7, ResampleMethod::kBest),
      resample("resample 0.7, linear", 0.7, ResampleMethod::kTrilinear),
      resample("resample 0.7, quadratic", 0.7, ResampleMethod::kQuadratic),
      {"resample 0.7, OpenVDB's rebuild", [](GridVolume& v) { rebuild(v, 0.7); }},
      resample("resample 1.5", 1.5, ResampleMethod::kBest),
      {"resample 1.5, OpenVDB's rebuild", [](GridVolume& v) { rebuild(v, 1.5); }},
      smooth("smooth mean:1", SmoothFilter::kMean, 1),
      smooth("smooth gaussian:1", SmoothFilter::kGaussian, 1),
      smooth("smooth median:1", SmoothFilter::kMedian, 1),
      smooth("smooth curvature:2", SmoothFilter::kCurvature, 2),
      {"offset 3, then -3",
       [](GridVolume& v) {
         offsetGrid(v, 3);
         offsetGrid(v, -3);
       }},
      {"open-close 3", [](GridVolume& v) { openCloseGrid(v, 3); }},
      {"intersect with itself on voxels of 0.9",
       [](GridVolume& v) {
         GridVolume other{.grid = v.grid->deepCopyGrid(), .distances = true};
         resampleGrid(other, {.voxelSize = 0.9});
         combineGrids(v, CombineKind::kIntersect, other);
       }},
      {"keep largest, fill-cavities",
       [](GridVolume& v) {
         keepComponents(v, {.most = 1});
         fillCavities(v);
       }},
  };
}

void printRow(const std::string& step, const Mesh& mesh, const eval::Shape& shape, double before) {
  const eval::Pose pose = eval::randomPose(5, kSize);
  const eval::Figures f = eval::measure(mesh, shape, pose);
  const auto edge = shape.edges.empty() ? std::string("") : fmt::format("{:.3f}", f.edgeRms);
  const double volume = analyze(mesh).volume;
  fmt::print("| {} | {} | {:.3f} | {:.1f} | {:+.2f} |\n", step, edge, f.vertexRms, f.normalP99,
             1e2 * (volume / before - 1));
  std::fflush(stdout);
}

void printSolid(const std::string& title, const eval::Shape& shape, double noise) {
  const eval::Pose pose = eval::randomPose(5, kSize);
  const auto exact = eval::makeGrid("exact", shape, pose, noise, 1).grid;
  const double before = analyze(meshOf(settleGrid(eval::makeGrid("exact", shape, pose, 0, 1).grid))).volume;
  fmt::print("\n{}\n\n| step | creases | vertices | normals | volume % |\n|---|---|---|---|---|\n", title);
  for (const Step& step : allSteps()) {
    GridVolume volume = settleGrid(exact->deepCopy());
    step.run(volume);
    printRow(step.name, meshOf(volume), shape, before);
  }
}

}  // namespace

int main() {
  openvdb::initialize();
  for (const eval::Shape& shape : eval::makeShapes(kSize)) {
    if (shape.name != "box" && shape.name != "sphere" && shape.name != "torus") continue;
    printSolid(shape.name, shape, 0);
    if (shape.name == "box") printSolid(fmt::format("box, noise of {} voxels", kNoise), shape, kNoise);
  }
}
