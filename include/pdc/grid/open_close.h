#pragma once

#include "pdc/grid/grid_volume.h"
#include "pdc/monitor.h"

namespace pdc {

/// Opens a level set and closes it then: moves its surface inwards by `distance`, world units, finite and above 0,
/// outwards by twice that, and inwards again. Parts thinner than twice the distance go, and so do gaps and cavities;
/// what is left has its place, but rounded creases. Moves as offsetGrid() does; what vanished on the way stays away.
/// \throws what offsetGrid() does, and std::invalid_argument for a distance that is not above 0.
void openCloseGrid(GridVolume& volume, double distance, GridStepReport* report = nullptr, const Monitor& monitor = {});

}  // namespace pdc
