#pragma once

#include "pdc/grid/grid_volume.h"
#include "pdc/monitor.h"

namespace pdc::detail {

/// Moves the surface of a level set whose values are distances; see offsetGrid(). \throws Error if it is too far;
/// Cancelled.
void offsetBand(GridVolume& volume, double distance, const Monitor& monitor);

}  // namespace pdc::detail
