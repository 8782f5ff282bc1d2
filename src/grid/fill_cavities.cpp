#include "pdc/grid/fill_cavities.h"

#include "grid/flip_parts.h"
#include "grid/real_grid.h"

namespace pdc {

void fillCavities(GridVolume& volume, GridStepReport* report, const Monitor& monitor) {
  monitor.throwIfStopped();
  detail::StepRecord record(volume, report);
  const auto all = [](std::size_t, std::uint64_t) { return true; };
  const detail::FlippedParts parts = detail::flipParts(volume, false, all);
  record.finish(volume);
  if (report != nullptr) report->partsBefore = parts.before;
}

}  // namespace pdc
