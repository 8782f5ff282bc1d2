#pragma once

#include "pdc/grid/grid_volume.h"
#include "pdc/monitor.h"

namespace pdc {

/// Makes a fog volume the level set of its surface at `iso`, in its units, finite: distances to its contour, in a band
/// of three voxels to each side. Voxels that are no cubes become cubes with their shortest edge.
/// \throws std::invalid_argument for an isovalue that is not finite, and a volume without a grid; Error for a level
/// set, and for what does not fit into the memory; Cancelled.
void fogToLevelSet(GridVolume& volume, double iso, GridStepReport* report = nullptr, const Monitor& monitor = {});

}  // namespace pdc
