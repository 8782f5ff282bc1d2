#pragma once

#include <functional>
#include <vector>

#include "pdc/math/mat3.h"
#include "sample/creases/distance_stencil.h"

namespace pdc::detail {

/// What some of a grid's values say about all of them.
struct DistanceProbe {
  /// Median of | |∇φ| − 1 |: near 0 for distances, whatever for other values. Infinite if there are too few values.
  double slopeError;
  /// Standard deviation of Gaussian noise in the values, in voxels; 0 where there is texture.
  double noise;
  /// How rough the surface is at the size of a voxel where that is no Gaussian noise, measured as noise is; or 0.
  double texture;
};

/// The most blocks that are worth looking at.
inline constexpr std::size_t kProbeBlocks = 64;

/// Looks at the values of some blocks, in parallel.
///
/// Slopes are central differences within two voxels of the surface. Noise is the first quartile of the sizes of third
/// differences along the axes, over what it is for Gaussian noise of deviation 1, or that of fourth ones if it is less:
/// smooth surfaces have third differences of the order of their curvature's square, and fourth ones of its cube, and
/// creases move a quartile less than a median. Where most
/// voxels are beside a crease it is still up to half too high. It is texture instead where fourth differences are as
/// large, which curvature's are not, but the third ones are not spread as Gaussian noise spreads them: surfaces rough
/// at the size of a voxel, as scanned meshes are, have many small ones. \param K from steps in world space, in voxels,
/// to lattice units. \param read fills a block's stencil; called from many threads.
[[nodiscard]] DistanceProbe probeDistances(const std::vector<Coord>& blocks, const Mat3d& K,
                                           const std::function<void(const Coord&, DistanceStencil&)>& read);

}  // namespace pdc::detail
