#pragma once

#include <openvdb/Grid.h>

#include "pdc/sample/lattice_map.h"

namespace pdc::detail {

/// From a grid's index space to its world. \throws Error for transforms that are singular or not finite.
[[nodiscard]] LatticeMap gridMap(const openvdb::GridBase& grid);

}  // namespace pdc::detail
