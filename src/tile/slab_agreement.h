#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "pdc/tile/slab_folder.h"
#include "tile/slab_file.h"

namespace pdc::detail {

/// The file of a slab; nothing if it is not done. \throws Error if it is damaged or of another plan.
[[nodiscard]] std::optional<SlabFile> openSlab(const SlabFolder& folder, std::size_t slab);

/// Whether two neighbours made the same of what both contoured.
[[nodiscard]] bool agree(const SlabHeader& lower, const SlabHeader& upper);

/// How many layers about it a slab is to be contoured with; nothing if it is done and no neighbour that is done
/// disagrees with it, or those that do have to catch up first. A file that is damaged counts as none.
[[nodiscard]] std::optional<int> wantedHalo(const SlabFolder& folder, std::size_t slab);

/// "slabs 3 to 9; there are 5, from 0".
[[nodiscard]] std::string slabRangeText(std::size_t first, std::size_t last, std::size_t count);

}  // namespace pdc::detail
