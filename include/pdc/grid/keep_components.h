#pragma once

#include <cstddef>
#include <limits>

#include "pdc/grid/grid_volume.h"
#include "pdc/monitor.h"

namespace pdc {

/// Which parts are kept: both have to hold.
struct KeepOptions {
  std::size_t most = std::numeric_limits<std::size_t>::max();  ///< So many, the largest ones by their voxels.
  std::size_t moreVoxelsThan = 0;                              ///< Those of more voxels inside.
};

/// Leaves the largest parts of the solid. A part is the voxels inside that are connected along the axes, tiles and
/// inactive voxels included; cavities in it are no parts. Values of what goes are mirrored about the isovalue and lie
/// outside then; of a level set, what is farther from the surface than its band becomes inactive background. Where
/// parts lie closer together than the band, values between them are less than the distance to what is left.
/// Works on all volumes. The report has the number of parts. \throws std::invalid_argument for a volume without a grid;
/// Cancelled.
void keepComponents(GridVolume& volume, const KeepOptions& options, GridStepReport* report = nullptr,
                    const Monitor& monitor = {});

}  // namespace pdc
