#pragma once

#include "pdc/grid/grid_volume.h"
#include "pdc/monitor.h"

namespace pdc {

enum class CombineKind {
  kUnion,      ///< What is in either solid.
  kIntersect,  ///< What is in both.
  kSubtract,   ///< What is not in the other one.
};

/// Combines the solids of two level sets on the lattice of the first. If the other one has another lattice, type or
/// width of its band, it is the level set of its contour there. Creases where the surfaces cross are as sharp as the
/// lattice has them; distances beside them are those to the nearer or the farther surface, as
/// openvdb::tools::csgUnion() and its like leave them. \throws std::invalid_argument for a volume without a grid; Error
/// for fog volumes, voxels of `volume` that are no cubes, and what does not fit into the memory; Cancelled.
void combineGrids(GridVolume& volume, CombineKind kind, const GridVolume& other, GridStepReport* report = nullptr,
                  const Monitor& monitor = {});

}  // namespace pdc
