#pragma once

#include "pdc/grid/grid_volume.h"
#include "pdc/monitor.h"

namespace pdc {

/// How the values of the new voxels are found.
enum class ResampleMethod {
  kBest,       ///< kContour for level sets, kTrilinear for fog volumes.
  kContour,    ///< Distances to the contour of the old grid, which keeps creases; makes a level set.
  kTrilinear,  ///< Linear interpolation between the eight voxels around.
  kQuadratic,  ///< OpenVDB's quadratic interpolation of 27 voxels.
};

struct ResampleOptions {
  double voxelSize = 0;  ///< Edge of the new voxels, world units, finite and above 0.
  ResampleMethod method = ResampleMethod::kBest;
};

/// Puts a volume on voxels of another size, which are cubes. Where the old ones are cubes, turned or mirrored ones
/// too, the new lattice has their axes and shares the point 0, 0, 0 with theirs; otherwise it has those of the world.
/// A level set gets the half width, in voxels, that it had, and at least three.
/// \throws std::invalid_argument for a voxel size that is not finite and above 0, and a volume without a grid; Error if
/// the new grid is not expected to fit into the memory or into what coordinates hold; Cancelled.
void resampleGrid(GridVolume& volume, const ResampleOptions& options, GridStepReport* report = nullptr,
                  const Monitor& monitor = {});

}  // namespace pdc
