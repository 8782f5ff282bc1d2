#pragma once

#include "pdc/math/mat3.h"
#include "sample/distance_window.h"

namespace pdc::detail {

/// Below which errors samples count, in voxels or, for slopes, without unit.
struct PlaneTolerance {
  float error;  ///< Samples whose error is larger count for nothing.
  float usual;  ///< Samples whose error is smaller are as good as any.
  float kink;   ///< One-sided slopes that differ by more lie on different sides of a crease.
};

/// A plane that the distances about one voxel agree on: through the point of the surface nearest to it.
struct SurfaceSample {
  Vec3f normal;  ///< In world space.
  Vec3f foot;    ///< Lattice units from the block's origin.
  float weight;  ///< How much it says that there is such a piece of surface, in (0, 1].
  float trust;   ///< How much it says where, beside others of the same piece; in (0, weight].
};

/// The planes of one voxel: one where its surroundings are smooth, more where a crease's bisector passes by.
struct VoxelPlanes {
  static constexpr int kMax = 3;
  std::array<SurfaceSample, kMax> plane;
  int count = 0;
};

/// Along each axis slopes are taken from both sides (see OneSidedSlopes), so that one sees one side of a crease only. A
/// combination of slopes, one of the eight octants, is believed as far as it has length one, as a distance's gradient
/// has, and its octant's face diagonals hold what it predicts. \param K from steps in world space, in voxels, to
/// lattice units; Kᵀ takes slopes along the lattice to gradients.
[[nodiscard]] VoxelPlanes voxelPlanes(const DistanceWindow& window, const Coord& voxel, const PlaneTolerance& tolerance,
                                      const Mat3f& K);

}  // namespace pdc::detail
