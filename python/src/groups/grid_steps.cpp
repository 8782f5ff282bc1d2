#include "pdc/grid/grid_steps.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "convert.h"
#include "given_options.h"
#include "groups/groups.h"
#include "inputs/grid_handle.h"
#include "inputs/request.h"
#include "io/vdb/grid_warnings.h"
#include "pdc/grid/mesh_to_level_set.h"
#include "polite_run.h"
#include "remedies.h"
#include "reports/json_report.h"

namespace pdc::python {
namespace {

const Words<ResampleMethod> kMethods{{"best", ResampleMethod::kBest},
                                     {"contour", ResampleMethod::kContour},
                                     {"linear", ResampleMethod::kTrilinear},
                                     {"quadratic", ResampleMethod::kQuadratic}};
const Words<SmoothFilter> kFilters{{"mean", SmoothFilter::kMean},
                                   {"gaussian", SmoothFilter::kGaussian},
                                   {"median", SmoothFilter::kMedian},
                                   {"curvature", SmoothFilter::kCurvature}};
const Words<CombineKind> kKinds{
    {"union", CombineKind::kUnion}, {"intersect", CombineKind::kIntersect}, {"subtract", CombineKind::kSubtract}};

/// A grid after steps, their reports, and warnings.
using Stepped = std::tuple<GridHandle, py::object, std::vector<std::string>>;

/// What comes of a grid, while the interpreter's lock is released.
struct Run {
  GridVolume volume;
  std::vector<GridStepReport> steps;
  std::vector<std::string> warnings;
};

Stepped steppedOf(Run run) {
  for (const GridStepReport& step : run.steps)
    for (const std::string& warning : step.warnings) run.warnings.push_back(step.name + ": " + warning);
  GridHandle handle{run.volume.grid, run.volume};
  return {std::move(handle), toPython(toJson(run.steps)), inPythonsWords(run.warnings)};
}

/// A copy that steps may change: what earlier ones left, or else what the options and the values say of the grid.
GridVolume volumeOf(const GridHandle& handle, const std::optional<SettleOptions>& options,
                    std::vector<std::string>& warnings) {
  if (handle.settled && !options) {
    GridVolume volume = *handle.settled;
    volume.grid = volume.grid->deepCopyGrid();
    return volume;
  }
  GridMeaning meaning;
  GridVolume volume = settleGrid(handle.grid->deepCopyGrid(), options.value_or(SettleOptions{}), &meaning);
  warnings = detail::gridWarnings(meaning, detail::OptionStyle::kProgram);
  return volume;
}

/// How a grid is said to be read; nothing where nothing is said.
std::optional<SettleOptions> settleOptionsOf(const GivenOptions& reading) {
  bool said = false;
  for (const char* name : {"level", "grid_class", "inside", "flood_fill", "nan"})
    said = said || !reading.given(name).is_none();
  if (!said) return std::nullopt;
  return SettleOptions{.meaning = meaningOf(reading), .acceptNonFinite = acceptsNonFinite(reading)};
}

void takeClip(const GivenOptions& asked, GridSteps& steps) {
  const py::object box = asked.given("clip_box"), mask = asked.given("clip_mask");
  if (box.is_none() && mask.is_none()) return;
  ClipOptions clip;
  asked.take("closed", clip.closed);
  if (mask.is_none()) {
    const auto b = box.cast<std::array<double, 6>>();
    clip.box = {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
  } else {
    clip.mask = mask.cast<GridHandle>().grid;
  }
  steps.clip = clip;
}

GridSteps stepsOf(const GivenOptions& asked) {
  GridSteps steps;
  asked.take("fog_to_level_set", steps.fogToLevelSet);
  takeClip(asked, steps);
  if (!asked.given("resample").is_none()) {
    ResampleOptions resample;
    asked.take("resample", resample.voxelSize);
    asked.takeWord("method", kMethods, resample.method);
    steps.resample = resample;
  }
  if (!asked.given("smooth").is_none()) {
    SmoothGridOptions smooth;
    asked.take("smooth", smooth.radius);
    asked.takeWord("filter", kFilters, smooth.filter);
    steps.smooth = smooth;
  }
  asked.take("offset", steps.offset);
  asked.take("open_close", steps.openClose);
  if (!asked.given("most").is_none() || !asked.given("above").is_none()) {
    KeepOptions keep;
    asked.take("most", keep.most);
    asked.take("above", keep.moreVoxelsThan);
    steps.keep = keep;
  }
  asked.take("fill_cavities", steps.fillCavities);
  return steps;
}

/// Takes steps on a grid. \param others the grids that a "combine" of the options joins with it, read as they are.
Stepped takeSteps(const GridHandle& grid, const py::dict& given, const std::vector<GridHandle>& others,
                  const py::object& progress) {
  const GivenOptions asked(given);
  const auto settle = settleOptionsOf(asked);
  GridSteps steps = stepsOf(asked);
  CombineKind kind{};
  asked.takeWord("combine", kKinds, kind);
  return steppedOf(makePolitely(progress, asked.threads(), [&](const Monitor& monitor) {
    Run run;
    run.volume = volumeOf(grid, settle, run.warnings);
    for (const GridHandle& other : others) {
      std::vector<std::string> warnings;
      steps.combine.push_back(
          {.kind = kind, .other = volumeOf(other, std::nullopt, warnings), .name = other.grid->getName()});
      run.warnings.insert(run.warnings.end(), warnings.begin(), warnings.end());
    }
    applyGridSteps(run.volume, steps, &run.steps, monitor);
    if (steps.fogToLevelSet) run.volume.iso = 0;
    return run;
  }));
}

Stepped fromMesh(const MeshHandle& mesh, double voxelSize, double halfWidth, int threads, const py::object& progress) {
  return steppedOf(makePolitely(progress, threads, [&](const Monitor& monitor) {
    Run run;
    GridStepReport report;
    report.name = "mesh-to-level-set";
    report.parameter = halfWidth > 0 ? fmt::format("{}:{}", voxelSize, halfWidth) : fmt::format("{}", voxelSize);
    run.volume = meshToLevelSet(*mesh.mesh, {.voxelSize = voxelSize, .halfWidth = halfWidth}, &report, monitor);
    run.steps.push_back(std::move(report));
    return run;
  }));
}

}  // namespace

void addGridSteps(py::module_& module) {
  module.def("grid_steps", &takeSteps);
  module.def("grid_from_mesh", &fromMesh);
}

}  // namespace pdc::python
