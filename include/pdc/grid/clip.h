#pragma once

#include <openvdb/Grid.h>

#include "pdc/grid/grid_volume.h"
#include "pdc/math/box.h"
#include "pdc/monitor.h"

namespace pdc {

/// What is kept of a grid: a box, or the voxels of another grid: the inside of a level set, else the active ones.
struct ClipOptions {
  Box box{};                           ///< World units, finite, lo < hi; counts where there is no mask.
  openvdb::GridBase::ConstPtr mask{};  ///< Of any scalar type and transform; null for a box.
  /// A level set that a box cuts stays one: its solid is intersected with the box, which closes it there with flat
  /// faces where the box has them, between voxels too. false: values outside of the box become the background and
  /// inactive, as by openvdb::tools::clip(), so that an open contour has no faces there. With a mask, and for fog
  /// volumes, it is always the latter.
  bool closed = true;
};

/// Leaves what lies within a box or a mask. Voxels that a box touches by half stay in it.
/// \throws std::invalid_argument for an empty box, one that is not finite, and a volume without a grid; Error for a
/// mask of a type that has no scalar values, and what rebuilding a level set throws; Cancelled.
void clipGrid(GridVolume& volume, const ClipOptions& options, GridStepReport* report = nullptr,
              const Monitor& monitor = {});

}  // namespace pdc
