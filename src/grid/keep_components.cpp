#include "pdc/grid/keep_components.h"

#include <fmt/format.h>

#include "grid/flip_parts.h"
#include "grid/real_grid.h"

namespace pdc {

void keepComponents(GridVolume& volume, const KeepOptions& options, GridStepReport* report, const Monitor& monitor) {
  monitor.throwIfStopped();
  detail::StepRecord record(volume, report);
  const auto flips = [&](std::size_t number, std::uint64_t voxels) {
    return number >= options.most || voxels <= options.moreVoxelsThan;
  };
  const detail::FlippedParts parts = detail::flipParts(volume, true, flips);
  if (parts.before > 0 && parts.flipped == parts.before)
    record.warn(fmt::format("no part of {} is kept; nothing is inside", parts.before));
  record.finish(volume);
  if (report == nullptr) return;
  report->partsBefore = parts.before;
  report->partsAfter = parts.before - parts.flipped;
}

}  // namespace pdc
