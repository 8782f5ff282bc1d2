#pragma once

#include <cstdint>
#include <functional>

#include "pdc/grid/grid_volume.h"

namespace pdc::detail {

/// How many parts a side had, and how many of them changed it.
struct FlippedParts {
  std::size_t before = 0, flipped = 0;
};

/// Puts parts of one side of a volume's surface on the other, by mirroring their values about the isovalue, and trims
/// the band of a level set. \param flips is asked of each part, from the largest (0) on, with its number of voxels.
FlippedParts flipParts(GridVolume& volume, bool inside, const std::function<bool(std::size_t, std::uint64_t)>& flips);

}  // namespace pdc::detail
