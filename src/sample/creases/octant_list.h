#pragma once

#include <array>
#include <cstdint>

#include "sample/creases/surface_samples.h"
#include "sample/creases/voxel_row.h"

namespace pdc::detail {

/// The scales that errors of samples are measured by, in voxels or, for slopes, without unit.
struct PlaneTolerance {
  float cutoff;  ///< Samples whose error is larger have no support (Tukey's biweight).
  float scale;   ///< Samples whose error is much larger have little weight in fits (Geman & McClure).
  float jump;    ///< One-sided slopes that differ by more lie on different sheets of a crease.
};

/// Octants of the voxels of one row after the other that may give samples, each a lane.
struct OctantList {
  static constexpr int kPerRow = kLanes * kOctants, kCapacity = 4 * kPerRow;
  using Column = std::array<float, kCapacity>;

  [[nodiscard]] bool hasRoomForRow() const { return count + kPerRow <= kCapacity; }

  /// Adds the octants of eight voxels. \param first value of the row. \param rowStart the row's first voxel, as in
  /// `voxel`. \param z of the first voxel, from the row's first. \param octants a byte per voxel.
  void add(const VoxelRow& row, const float* first, int rowStart, int z, std::uint64_t octants);

  /// Makes each octant's sample; those whose errors are beyond the cutoff have no support. \param K from world space,
  /// in voxels, to lattice steps. \param to by SurfaceSamples::Column; foot points are in lattice units.
  void makeSamples(SimdLevel level, const PlaneTolerance& tolerance, const Mat3f& K,
                   const std::array<float*, SurfaceSamples::kColumns>& to) const;

  alignas(64) std::array<Column, 3> slope;
  alignas(64) Column residual, value;
  alignas(64) std::array<std::int32_t, kCapacity> voxel;  ///< 256x + 16y + z, each from -1.
  int count = 0;
};

}  // namespace pdc::detail
