#pragma once

#include <array>

#include "pdc/math/mat3.h"
#include "pdc/math/quadric_lanes.h"
#include "sample/creases/voxel_row.h"

namespace pdc::detail {

/// Planes that the distances about single voxels agree on, each through its foot point: the point of the surface
/// nearest to its voxel.
struct SurfaceSamples {
  enum Column {
    kNormalX,  ///< Unit normal in world space.
    kNormalY,
    kNormalZ,
    kFootX,  ///< Foot point, from the centre of a cell, in world space, in voxels.
    kFootY,
    kFootZ,
    kSupport,    ///< How much it says that there is such a piece of surface, in [0, 1].
    kFitWeight,  ///< Its weight among others of the same piece in a fit, in [0, support].
    kColumns
  };
  /// An octant of each of the 4×4×4 voxels about a cell is a sample at most.
  static constexpr int kMost = 4 * 4 * 4 * kOctants, kCapacity = kMost + kLanes;

  [[nodiscard]] int blocks() const { return static_cast<int>(batchCount(static_cast<std::size_t>(count))); }
  [[nodiscard]] Vec3f normal(int i) const { return {column[kNormalX][i], column[kNormalY][i], column[kNormalZ][i]}; }
  [[nodiscard]] Vec3f foot(int i) const { return {column[kFootX][i], column[kFootY][i], column[kFootZ][i]}; }

  alignas(64) std::array<std::array<float, kCapacity>, kColumns> column;
  int count = 0;  ///< The rest of the last block of lanes has no support.
};

/// The samples of a block's voxels, by row of voxels.
struct VoxelSamples {
  static constexpr int kVoxels = kBlockPoints + 2;  ///< -1 to 9 on each axis.
  static constexpr int kCapacity = kVoxels * kVoxels * kVoxels * kOctants + kLanes;
  /// First sample of each voxel, end of the last, and room for what a row's lanes write beyond.
  using RowStarts = std::array<std::uint16_t, kVoxels + kLanes>;
  using Columns = std::array<std::array<float, kCapacity>, SurfaceSamples::kColumns>;

  /// Leaves of each voxel of a row the three samples with the most support, of several the last, and none without
  /// support, in their order: with noise more octants agree with themselves by chance. The row's first sample stays
  /// where it is.
  void keepSupported(int row);

  std::array<RowStarts, kVoxels * kVoxels> start;  ///< By row, kVoxels (x + 1) + y + 1.
  Columns column;                                  ///< As in SurfaceSamples; foot points in lattice units.
  int count = 0;

 private:
  void keepMostSupported(int most, int begin, int end);
};

}  // namespace pdc::detail
