#pragma once

#include "pdc/grid/grid_volume.h"
#include "pdc/monitor.h"

namespace pdc {

/// The farthest that a surface goes in one step, in voxels.
inline constexpr int kMostOffsetVoxels = 128;

/// Moves the surface of a level set by `distance`, world units, finite: outwards where it is above 0. By
/// openvdb::tools::LevelSetFilter, half a voxel at a time, the band being rebuilt each time.
/// \throws std::invalid_argument for a distance that is not finite, and a volume without a grid; Error for a fog
/// volume, for more than kMostOffsetVoxels and for voxels that are no cubes; Cancelled.
void offsetGrid(GridVolume& volume, double distance, GridStepReport* report = nullptr, const Monitor& monitor = {});

}  // namespace pdc
