#include "pdc/grid/grid_steps.h"

#include <fmt/format.h>
#include <openvdb/Exceptions.h>

#include <utility>

#include "pdc/error.h"
#include "pdc/grid/fill_cavities.h"
#include "pdc/grid/fog_to_level_set.h"
#include "pdc/grid/offset.h"
#include "pdc/grid/open_close.h"

namespace pdc {
namespace {

const char* nameOf(SmoothFilter filter) {
  switch (filter) {
    case SmoothFilter::kMean:
      return "mean";
    case SmoothFilter::kGaussian:
      return "gaussian";
    case SmoothFilter::kMedian:
      return "median";
    case SmoothFilter::kCurvature:
      return "curvature";
  }
  return "";
}

const char* nameOf(CombineKind kind) {
  return kind == CombineKind::kUnion ? "union" : kind == CombineKind::kIntersect ? "intersect" : "subtract";
}

std::string textOf(const KeepOptions& keep) {
  if (keep.moreVoxelsThan > 0) return fmt::format("above:{}", keep.moreVoxelsThan);
  return keep.most == 1 ? std::string("largest") : fmt::format("{}", keep.most);
}

std::string textOf(const ClipOptions& clip) {
  if (clip.mask) return clip.mask->getName();
  const auto& [lo, hi] = clip.box;
  return fmt::format("{},{},{},{},{},{}", lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
}

/// Collects reports.
class Recorder {
 public:
  explicit Recorder(std::vector<GridStepReport>* reports) : mReports(reports) {}

  /// Calls step(report), and names it before what it complains of.
  template <typename Step>
  void run(const char* name, std::string parameter, const Step& step) {
    GridStepReport report;
    report.name = name;
    report.parameter = std::move(parameter);
    try {
      step(mReports != nullptr ? &report : nullptr);
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", name, error.what()));
    } catch (const openvdb::Exception& error) {
      // Transforms that are nearly singular, for one.
      throw Error(fmt::format("{}: OpenVDB says: {}", name, error.what()));
    }
    if (mReports != nullptr) mReports->push_back(std::move(report));
  }

 private:
  std::vector<GridStepReport>* mReports;
};

}  // namespace

bool GridSteps::empty() const {
  return !fogToLevelSet && !clip && !resample && !smooth && !offset && !openClose && combine.empty() && !keep &&
         !fillCavities;
}

void applyGridSteps(GridVolume& volume, const GridSteps& steps, std::vector<GridStepReport>* reports,
                    const Monitor& monitor) {
  Recorder recorder(reports);
  if (const auto& iso = steps.fogToLevelSet)
    recorder.run("fog-to-level-set", fmt::format("{}", *iso),
                 [&](auto* report) { fogToLevelSet(volume, *iso, report, monitor); });
  if (const auto& clip = steps.clip)
    recorder.run("clip", textOf(*clip), [&](auto* report) { clipGrid(volume, *clip, report, monitor); });
  if (const auto& resample = steps.resample)
    recorder.run("resample", fmt::format("{}", resample->voxelSize),
                 [&](auto* report) { resampleGrid(volume, *resample, report, monitor); });
  if (const auto& smooth = steps.smooth)
    recorder.run("smooth", fmt::format("{}:{}", nameOf(smooth->filter), smooth->radius),
                 [&](auto* report) { smoothGrid(volume, *smooth, report, monitor); });
  if (const auto& offset = steps.offset)
    recorder.run("offset", fmt::format("{}", *offset),
                 [&](auto* report) { offsetGrid(volume, *offset, report, monitor); });
  if (const auto& distance = steps.openClose)
    recorder.run("open-close", fmt::format("{}", *distance),
                 [&](auto* report) { openCloseGrid(volume, *distance, report, monitor); });
  for (const CombineStep& step : steps.combine)
    recorder.run(nameOf(step.kind), step.name,
                 [&](auto* report) { combineGrids(volume, step.kind, step.other, report, monitor); });
  if (const auto& keep = steps.keep)
    recorder.run("keep", textOf(*keep), [&](auto* report) { keepComponents(volume, *keep, report, monitor); });
  if (steps.fillCavities)
    recorder.run("fill-cavities", "", [&](auto* report) { fillCavities(volume, report, monitor); });
}

}  // namespace pdc
