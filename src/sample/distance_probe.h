#pragma once

#include "pdc/math/mat3.h"
#include "sample/grid_sampler.h"

namespace pdc::detail {

/// What some of a grid's values say about all of them.
struct DistanceProbe {
  /// Median of | |∇φ| − 1 |: near 0 for distances, whatever for other values. Infinite if there are too few values.
  double slopeError;
  double noise;  ///< Standard deviation of white noise in the values, in voxels.
};

/// Looks at up to 64 leaves, spread evenly over the tree.
///
/// Slopes are central differences within two voxels of the surface. Noise is the first quartile of the sizes of third
/// differences along the axes, over what it is for Gaussian noise of deviation 1: smooth surfaces have third
/// differences of the order of their curvature's square, and creases move a quartile less than a median. Where most
/// voxels are beside a crease it is still up to half too high.
/// \param K from steps in world space, in voxels, to lattice units.
[[nodiscard]] DistanceProbe probeDistances(const GridSampler& sampler, const Mat3d& K, double voxelSize);

}  // namespace pdc::detail
