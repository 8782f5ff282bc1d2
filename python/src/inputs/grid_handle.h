#pragma once

#include <openvdb/Grid.h>

#include <optional>

#include "pdc/grid/grid_volume.h"

namespace pdc::python {

/// What Python holds of an OpenVDB grid, which does not change while anybody looks at it.
struct GridHandle {
  openvdb::GridBase::Ptr grid;
  /// What steps left, with this grid in it: where the surface is, and on which side its inside. Empty for others.
  std::optional<GridVolume> settled{};
};

}  // namespace pdc::python
