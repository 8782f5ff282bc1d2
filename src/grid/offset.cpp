#include "pdc/grid/offset.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetFilter.h>

#include <cmath>
#include <stdexcept>

#include "grid/level_set.h"
#include "grid/monitor_interrupter.h"
#include "grid/offset_band.h"
#include "grid/real_grid.h"
#include "pdc/error.h"

namespace pdc {

void detail::offsetBand(GridVolume& volume, double distance, const Monitor& monitor) {
  const double voxels = std::abs(distance) / volume.grid->voxelSize()[0];
  if (voxels > kMostOffsetVoxels)
    throw Error(fmt::format("an offset of {:.6g} is {:.3g} voxels; at most {}; larger voxels (--resample) allow more",
                            distance, voxels, kMostOffsetVoxels));
  // OpenVDB goes half a voxel at a time and calls start() four times to rebuild the band.
  const int starts = 1 + 4 * static_cast<int>(std::ceil(2 * voxels));
  MonitorInterrupter interrupter(monitor, "offsetting", starts);
  visitReal(volume, "offsetGrid", [&](auto& grid) {
    using Grid = std::decay_t<decltype(grid)>;
    if (grid.empty()) return;
    // OpenVDB's offset adds to the values, which moves the surface inwards.
    openvdb::tools::LevelSetFilter<Grid>(grid, &interrupter).offset(static_cast<typename Grid::ValueType>(-distance));
  });
}

void offsetGrid(GridVolume& volume, double distance, GridStepReport* report, const Monitor& monitor) {
  if (!std::isfinite(distance)) throw std::invalid_argument("offsetGrid: the distance must be finite");
  monitor.throwIfStopped();
  detail::StepRecord record(volume, report);
  detail::ensureDistances(volume, "an offset", record, monitor);
  detail::offsetBand(volume, distance, monitor);
  record.finish(volume);
}

}  // namespace pdc
