#include "pdc/grid/resample.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/GridTransformer.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "grid/level_set.h"
#include "grid/monitor_interrupter.h"
#include "grid/real_grid.h"
#include "parallel/with_threads.h"
#include "pdc/error.h"

namespace pdc {
namespace {

template <typename GridT>
void sample(const GridT& from, GridT& to, ResampleMethod method, const Monitor& monitor) {
  detail::MonitorInterrupter interrupter(monitor, "resampling");
  openvdb::util::NullInterrupter& base = interrupter;
  if (method == ResampleMethod::kQuadratic) {
    openvdb::tools::resampleToMatch<openvdb::tools::QuadraticSampler>(from, to, base);
  } else {
    openvdb::tools::resampleToMatch<openvdb::tools::BoxSampler>(from, to, base);
  }
}

/// Whether there are active tiles, or inactive values that say more than the background does, as those inside of a
/// level set do.
template <typename GridT>
bool hasMoreThanVoxels(const GridT& grid) {
  if (grid.tree().hasActiveTiles()) return true;
  for (auto value = grid.cbeginValueOff(); value; ++value)
    if (*value != grid.background()) return true;
  return false;
}

template <typename GridT>
typename GridT::Ptr interpolated(const GridT& grid, const openvdb::math::Transform& target, ResampleMethod method,
                                 const Monitor& monitor) {
  auto result = GridT::create(grid.background());
  result->setTransform(target.copy());
  // OpenVDB rebuilds what is of class level set, and does not interpolate it.
  const auto source = openvdb::gridConstPtrCast<GridT>(grid.copyGridReplacingMetadata(openvdb::MetaMap()));
  if (hasMoreThanVoxels(grid)) {
    // Where OpenVDB joins what threads made, it forgets inactive values, and takes those of tiles beyond their borders.
    // One thread has nothing to join.
    detail::withThreads(1, [&] { sample(*source, *result, method, monitor); });
    openvdb::tools::prune(result->tree());
  } else {
    sample(*source, *result, method, monitor);
  }
  return result;
}

}  // namespace

void resampleGrid(GridVolume& volume, const ResampleOptions& options, GridStepReport* report, const Monitor& monitor) {
  if (!std::isfinite(options.voxelSize) || !(options.voxelSize > 0))
    throw std::invalid_argument("resampleGrid: the voxel size must be finite and above 0");
  monitor.throwIfStopped();
  detail::StepRecord record(volume, report);
  const bool levelSet = volume.gridClass == GridClass::kLevelSet;
  const ResampleMethod method = options.method != ResampleMethod::kBest ? options.method
                                : levelSet                              ? ResampleMethod::kContour
                                                                        : ResampleMethod::kTrilinear;
  detail::visitReal(volume, "resampleGrid", [&](auto& grid) {
    const auto target = detail::cubicTransform(grid.transform(), options.voxelSize);
    if (method == ResampleMethod::kContour) {
      const double iso = levelSet ? volume.iso : 0;
      if (levelSet) volume.iso = 0;
      detail::rebuildLevelSet(volume, *target, detail::halfWidthOf(volume), monitor);
      volume.iso = iso;
      return;
    }
    detail::checkResampling(grid, *target);
    detail::replaceGrid(volume, interpolated(grid, *target, method, monitor));
    volume.distances = false;
  });
  record.finish(volume);
}

}  // namespace pdc
