#pragma once

#include <array>

#include "pdc/math/mat3.h"
#include "pdc/math/quadric_lanes.h"
#include "pdc/math/simd_level.h"
#include "sample/creases/distance_stencil.h"

namespace pdc::detail {

/// Below which errors samples count, in voxels or, for slopes, without unit.
struct PlaneTolerance {
  float error;  ///< Samples whose error is larger count for nothing.
  float usual;  ///< Samples whose error is smaller are as good as any.
  float jump;   ///< One-sided slopes that differ by more lie on different sheets of a crease.
};

/// Planes that the distances about single voxels agree on, each through the point of the surface nearest to its voxel.
struct SurfaceSamples {
  enum Column {
    kNormalX,  ///< Unit normal in world space.
    kNormalY,
    kNormalZ,
    kFootX,  ///< The point, from the centre of a cell, in world space, in voxels.
    kFootY,
    kFootZ,
    kWeight,  ///< How much it says that there is such a piece of surface, in [0, 1].
    kTrust,   ///< How much it says where, beside others of the same piece; in [0, weight].
    kColumns
  };
  static constexpr int kOctants = 8;
  /// Of the 4×4×4 voxels about a cell, one per octant.
  static constexpr int kMost = 4 * 4 * 4 * kOctants, kCapacity = kMost + kLanes;

  [[nodiscard]] int blocks() const { return static_cast<int>(batchCount(static_cast<std::size_t>(count))); }
  [[nodiscard]] Vec3f normal(int i) const { return {column[kNormalX][i], column[kNormalY][i], column[kNormalZ][i]}; }
  [[nodiscard]] Vec3f foot(int i) const { return {column[kFootX][i], column[kFootY][i], column[kFootZ][i]}; }

  alignas(64) std::array<std::array<float, kCapacity>, kColumns> column;
  int count = 0;  ///< The rest of the last block of lanes has no weight.
};

struct OctantList;

/// The samples of a block's voxels, found when the first are asked for.
///
/// Along each axis a voxel has slopes from both sides (see OneSidedSlopes), so that one sees one sheet of a crease
/// only. A combination of slopes, one of the eight octants, is believed as far as it has length one, as a distance's
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
  /// Collects the samples of the 4×4×4 voxels about a cell of the block; the nearer their foot, the more they weigh.
  void gather(const Coord& cell, SurfaceSamples& samples);

 private:
  static constexpr int kVoxels = kBlockPoints + 2;  ///< -1 to 9 on each axis.
  static constexpr int kCapacity = kVoxels * kVoxels * kVoxels * SurfaceSamples::kOctants + kLanes;
  /// First sample of each voxel, end of the last, and room for what a row's lanes write beyond.
  using RowStarts = std::array<std::uint16_t, kVoxels + kLanes>;
  using Columns = std::array<std::array<float, kCapacity>, SurfaceSamples::kColumns>;

  /// Of all voxels that are needed.
  void find();
  void addRow(int row, OctantList& list);
  /// Of a voxel's samples only three count: with noise more octants agree with themselves by chance.
  void keepHeaviest(int most, int begin, int end);
  void dropWeightless(int row);

  const DistanceStencil& mStencil;
  PlaneTolerance mTolerance;
  Mat3f mM, mK;
  SimdLevel mLevel;

  std::array<std::uint16_t, kVoxels * kVoxels> mNeeded{};  ///< By row: bit z + 1.
  std::array<RowStarts, kVoxels * kVoxels> mStart;
  Columns mColumn;
  int mCount = 0;
  bool mFound = false;
};

}  // namespace pdc::detail
