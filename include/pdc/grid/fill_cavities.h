#pragma once

#include "pdc/grid/grid_volume.h"
#include "pdc/monitor.h"

namespace pdc {

/// Fills the parts of the outside that are not connected, along the axes, to where the tree ends, in the way in which
/// keepComponents() removes parts of the inside. Works on all volumes. The report has the number of cavities as
/// partsBefore. \throws std::invalid_argument for a volume without a grid; Cancelled.
void fillCavities(GridVolume& volume, GridStepReport* report = nullptr, const Monitor& monitor = {});

}  // namespace pdc
