#pragma once

#include <vector>

#include "pdc/sample/hermite_block.h"

namespace pdc::detail {

/// Sorts blocks by coordinate and removes duplicates. Runs in parallel.
void sortUnique(std::vector<Coord>& blocks);

}  // namespace pdc::detail
