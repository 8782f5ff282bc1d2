#pragma once

#include <array>
#include <span>

#include "extract/vertices/sigma_normal.h"
#include "pdc/math/quadric.h"
#include "pdc/sample/feature_planes.h"
#include "pdc/sample/hermite_block.h"
#include "pdc/sample/lattice_map.h"

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

/// Of a block whose lowest point is `origin`. Only a map that is not affine has a metric that changes from block to
/// block; within one it is taken as constant.
[[nodiscard]] CellMetric blockMetric(const LatticeMap& map, const Vec3d& origin);

/// The lowest point of a block.
[[nodiscard]] inline Vec3d blockOrigin(const Coord& block) {
  return {double(kBlockSize) * block[0], double(kBlockSize) * block[1], double(kBlockSize) * block[2]};
}

/// Hermite data of one surface patch in lattice units about the centre of its cell.
struct PatchSamples {
  static constexpr int kMax = 12;
  std::array<Vec3d, kMax> position;
  /// The row Mᵀn of each plane: |row · (x − position)| is the distance to it in voxels, measured in world space. Zero
  /// where there is no normal.
  std::array<Vec3d, kMax> row;
  int size = 0;
  /// What is known of each plane, if anything is: σn² besides the solver's, and its weight.
  bool noisy = false;
  std::array<double, kMax> variance, weight;
  /// Planes that take the place of those above, which then say only where the patch is; `point` from the centre too.
  std::span<const FeaturePlanes::Plane> features{};
  double featureSigma = 0;  ///< σn of them.
};

/// Mean squared distance of a place from the planes that place the vertex, in voxels squared.
[[nodiscard]] double planeError(const PatchSamples& samples, const Vec3d& x);

struct SolvedVertex {
  Vec3d x;                 ///< Lattice units from the centre of the cell.
  SymMat3<double> A;       ///< Of the patch's quadric.
  Vec3d halfGradient;      ///< Ax − b: zero where the vertex is the free minimiser.
  bool outOfCell = false;  ///< The free minimiser lay outside the cell.
  bool moved = false;      ///< The vertex is not the free minimiser.
};

/// Vertices stay this far inside their cell's walls, in lattice units, so that faces of neighbouring cells cannot touch
/// there.
inline constexpr double kCellMargin = 1e-4;
inline constexpr double kCellHalfSize = 0.5 - kCellMargin;

/// How far a free vertex may lie from the centre of its cell along an axis. On exact distance grids creases run up
/// to 1.5 voxels outside the cells that see them; beyond that a minimiser comes from an ill-conditioned system, not
/// from a feature.
inline constexpr double kFreeHalfSize = 2.0;

/// Places the vertex of a patch: minimises the sum of its probabilistic plane quadrics with Σn = σn² I in world space,
/// that is σn² G in lattice units.
class VertexSolver {
 public:
  /// \param halfSize how far vertices may lie from the centre of their cell along an axis, in lattice units.
  VertexSolver(const SigmaNormal& sigma, double halfSize);

  [[nodiscard]] SolvedVertex solve(const PatchSamples& samples, const CellMetric& metric) const;

  [[nodiscard]] const SigmaNormal& sigma() const { return mSigma; }
  [[nodiscard]] double halfSize() const { return mHalfSize; }
  /// True if σn is such that the free minimiser, A⁻¹ times the right-hand side about the mass point, may be found in
  /// single precision.
  [[nodiscard]] bool batched() const;

 private:
  /// σn² of a patch whose planes sum up to A.
  [[nodiscard]] double varianceOf(const SymMat3<double>& A, double weight, const CellMetric& metric) const;
  [[nodiscard]] SolvedVertex solveNoisy(const PatchSamples& samples, const Vec3d& massPoint,
                                        const CellMetric& metric) const;
  [[nodiscard]] SolvedVertex solveFeatures(const PatchSamples& samples, const CellMetric& metric) const;
  /// The minimiser of a regular quadric within the bounds.
  [[nodiscard]] SolvedVertex minimize(const Quadric<double>& q, const Vec3d& massPoint, const CellMetric& metric) const;
  [[nodiscard]] SolvedVertex solveClassical(Quadric<double> q, const Vec3d& massPoint, const CellMetric& metric) const;
  void constrain(SolvedVertex& v, const SymMat3<double>& A, const Vec3d& b) const;

  SigmaNormal mSigma;
  double mHalfSize;
};

}  // namespace pdc::detail
