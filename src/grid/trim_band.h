#pragma once

#include "pdc/grid/grid_volume.h"

namespace pdc::detail {

/// Makes the active voxels of a level set inactive, with the background's distance, whose values speak of a surface
/// that is not there: no voxel of the other sign is as near as they say. Does nothing where values are no distances.
void trimBand(GridVolume& volume);

}  // namespace pdc::detail
