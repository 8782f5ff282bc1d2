#include "pdc/grid/open_close.h"

#include <cmath>
#include <stdexcept>

#include "grid/level_set.h"
#include "grid/offset_band.h"
#include "grid/trim_band.h"

namespace pdc {

void openCloseGrid(GridVolume& volume, double distance, GridStepReport* report, const Monitor& monitor) {
  if (!std::isfinite(distance) || !(distance > 0))
    throw std::invalid_argument("openCloseGrid: the distance must be finite and above 0");
  monitor.throwIfStopped();
  detail::StepRecord record(volume, report);
  detail::ensureDistances(volume, "opening and closing", record, monitor);
  for (const double move : {-distance, 2 * distance, -distance}) {
    detail::offsetBand(volume, move, monitor);
    // Where all went, values still have the dent of what was there: the way back would make it again.
    detail::trimBand(volume);
  }
  record.finish(volume);
}

}  // namespace pdc
