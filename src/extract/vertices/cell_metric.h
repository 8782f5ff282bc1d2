#pragma once

#include "pdc/math/mat3.h"
#include "pdc/math/sym_mat3.h"
#include "pdc/sample/hermite_block.h"
#include "pdc/sample/lattice_map.h"
#include "sample/block_origin.h"

namespace pdc::detail {

/// Lengths in world space seen from a cell: for a step d in lattice units, |M d| is its length in voxels.
struct CellMetric {
  /// \param jacobian of the lattice map; \param voxelSize the length that counts as one.
  CellMetric(const Mat3d& jacobian, double voxelSize);
  [[nodiscard]] SymMat3<double> inverseG() const;

  double voxelSize;
  Mat3d M;
  SymMat3<double> G;      ///< MᵀM.
  bool identity = false;  ///< True for the common case of a uniform, unrotated lattice, where M = G = I.
};

/// The metric of a block whose lowest point is `origin`. Only a map that is not affine has a metric that changes from
/// block to block; within one it is taken as constant.
[[nodiscard]] CellMetric blockMetric(const LatticeMap& map, const Vec3d& origin);

/// The centre of a cell, from its block's lowest point.
[[nodiscard]] inline Vec3d cellCenter(BlockCell cell) { return {cell.x() + 0.5, cell.y() + 0.5, cell.z() + 0.5}; }

}  // namespace pdc::detail
