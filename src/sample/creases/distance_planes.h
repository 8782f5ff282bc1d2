#pragma once

#include <functional>
#include <span>

#include "pdc/math/mat3.h"
#include "pdc/sample/feature_planes.h"
#include "pdc/sample/hermite_block.h"
#include "sample/creases/distance_stencil.h"

namespace pdc::detail {

/// What the estimator needs to know of a grid of distances.
struct DistanceModel {
  Mat3d M;             ///< From lattice steps to world space, in voxels.
  double noise = 0;    ///< Standard deviation of the distances, in voxels.
  double texture = 0;  ///< See DistanceProbe.
};

/// A block as the estimator is given it.
struct SampledBlock {
  const BlockSigns& signs;
  const EdgeIndex& edges;
  const HermiteBlock& hermite;
  std::span<const SurfacePatch> patches;
};

/// Fills the planes of those patches beside which the distances show a crease.
///
/// Where the normals of a patch's crossings agree there is none. Otherwise each voxel of the 4×4×4 about the cell that
/// sees a smooth piece of surface (see VoxelPlanes) tells where that piece lies. A patch gathers those near it, sorts
/// them into sheets, and replaces its crossings' planes by one plane per sheet, through and tangent to the sheet where
/// all sheets meet. Sheets that none of its crossings lies on, unless they meet within the cell, and those that have no
/// point in common with the others, are left out. \param read fills the rows of the block's stencil; called at most
/// once.
void findFeaturePlanes(const SampledBlock& block, const DistanceModel& model,
                       const std::function<void(DistanceStencil&)>& read, FeaturePlanes& planes);

}  // namespace pdc::detail
