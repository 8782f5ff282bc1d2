#pragma once

#include "pdc/grid/grid_volume.h"
#include "pdc/monitor.h"

namespace pdc {

enum class SmoothFilter {
  kMean,       ///< The mean over a cube.
  kGaussian,   ///< Four times the mean over a cube: near to a Gaussian.
  kMedian,     ///< The median over a cube.
  kCurvature,  ///< Flow by mean curvature; for level sets only.
};

struct SmoothGridOptions {
  SmoothFilter filter = SmoothFilter::kMean;
  /// World units, finite and above 0. Of a cube, half its edge: it has 2 w + 1 voxels along each axis, w being the
  /// radius in voxels, rounded. Of a flow, the radius of the ball that it shrinks to nothing.
  double radius = 0;
};

/// The largest radius in voxels: of means; of medians, whose time grows with its third power; of flows, with its
/// square.
inline constexpr int kMostSmoothVoxels = 64, kMostMedianVoxels = 8, kMostFlowVoxels = 16;

/// Filters the values of a volume: a level set by openvdb::tools::LevelSetFilter, which keeps its band, a fog volume by
/// openvdb::tools::Filter, active tiles and the voxels within the kernel of active ones included. Rounds creases.
/// \throws std::invalid_argument for a radius that is not finite and above 0, and a volume without a grid; Error for a
/// radius below half a voxel or beyond the limits, for voxels that are no cubes, and for kCurvature with a fog volume;
/// Cancelled.
void smoothGrid(GridVolume& volume, const SmoothGridOptions& options, GridStepReport* report = nullptr,
                const Monitor& monitor = {});

}  // namespace pdc
