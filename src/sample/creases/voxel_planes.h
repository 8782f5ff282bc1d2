#pragma once

#include <array>

#include "pdc/math/mat3.h"
#include "pdc/math/simd_level.h"
#include "sample/creases/distance_stencil.h"
#include "sample/creases/octant_list.h"
#include "sample/creases/surface_samples.h"

namespace pdc::detail {

/// The samples of a block's voxels, found when the first are asked for.
///
/// Along each axis a voxel has slopes from both sides (see OneSidedSlopes), so that one sees one sheet of a crease
/// only. A combination of slopes, one of the eight octants, has support as far as it has length one, as a distance's
/// gradient has, and its octant's face diagonals hold what it predicts. A voxel whose surroundings are smooth has one
/// sample, more where a crease's bisector passes by.
class VoxelPlanes {
 public:
  /// \param stencil must outlive this. \param M from lattice steps to world space, in voxels. \param level changes no
  /// bit of the samples.
  VoxelPlanes(const DistanceStencil& stencil, const PlaneTolerance& tolerance, const Mat3f& M,
              SimdLevel level = bestSimdLevel())
      : mStencil(stencil), mTolerance(tolerance), mM(M), mK(inverse(M)), mLevel(level) {}

  /// Must be called for all cells that gather() will be called for, before the first.
  void request(const Coord& cell);
  /// Collects the samples of the 4×4×4 voxels about a cell of the block. The farther their foot points lie from it, the
  /// less support they have.
  void gather(const Coord& cell, SurfaceSamples& samples);

 private:
  static constexpr int kVoxels = VoxelSamples::kVoxels;

  /// Finds the samples of all voxels that were requested.
  void find();
  /// Lists the octants of a row's voxels, and sets where their samples will start.
  void listRow(int row, OctantList& list);

  const DistanceStencil& mStencil;
  PlaneTolerance mTolerance;
  Mat3f mM, mK;
  SimdLevel mLevel;

  std::array<std::uint16_t, kVoxels * kVoxels> mRequested{};  ///< By row: bit z + 1.
  VoxelSamples mSamples;
  bool mFound = false;
};

}  // namespace pdc::detail
