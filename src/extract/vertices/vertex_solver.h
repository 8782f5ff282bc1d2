#pragma once

#include "extract/vertices/cell_metric.h"
#include "extract/vertices/patch_samples.h"
#include "extract/vertices/sigma_normal.h"
#include "pdc/math/quadric.h"

namespace pdc::detail {

struct SolvedVertex {
  Vec3d x;                 ///< Lattice units from the centre of the cell.
  SymMat3<double> A;       ///< The matrix of the patch's quadric; see PatchQuadric.
  Vec3d halfGradient;      ///< Ax − b, in the same units: zero where the vertex is the free minimiser.
  bool outOfCell = false;  ///< The free minimiser lay outside the cell.
  bool moved = false;      ///< The vertex is not the free minimiser.
};

/// The quadric of a patch in lattice units from the centre of its cell; its values are voxels squared.
struct PatchQuadric {
  Quadric<double> q;
  Vec3d massPoint;  ///< Mean of the crossings, unweighted.
};

/// Vertices stay this far inside their cell's walls, in lattice units, so that faces of neighbouring cells cannot touch
/// there.
inline constexpr double kCellMargin = 1e-4;
inline constexpr double kCellHalfSize = 0.5 - kCellMargin;

/// How far a free vertex may lie from the centre of its cell along an axis. On exact distance grids creases run up
/// to 1.5 voxels outside the cells that see them; beyond that a minimiser comes from an ill-conditioned system, not
/// from a feature.
inline constexpr double kFreeHalfSize = 2.0;

/// Solves the QEF of a patch: the vertex minimises the sum of its probabilistic plane quadrics with Σn = σn² I in world
/// space, that is σn² G in lattice units (Trettner & Kobbelt 2020, equations 6-8).
class VertexSolver {
 public:
  /// \param halfSize how far vertices may lie from the centre of their cell along an axis, in lattice units.
  VertexSolver(const SigmaNormal& sigma, double halfSize);

  /// See SigmaNormal.
  void setNoise(double noise) { mSigma.setNoise(noise); }
  [[nodiscard]] SolvedVertex solve(const PatchSamples& samples, const CellMetric& metric) const;
  /// The quadric that solve() minimises.
  [[nodiscard]] PatchQuadric quadric(const PatchSamples& samples, const CellMetric& metric) const;

  [[nodiscard]] const SigmaNormal& sigma() const { return mSigma; }
  [[nodiscard]] double halfSize() const { return mHalfSize; }
  /// True if σn is such that the free minimiser, A⁻¹ times the right-hand side about the mass point, may be found in
  /// single precision.
  [[nodiscard]] bool batched() const;

 private:
  /// σn² of a patch whose planes sum up to A.
  [[nodiscard]] double varianceOf(const SymMat3<double>& A, double weight, const PatchSamples& samples,
                                  const CellMetric& metric) const;
  [[nodiscard]] PatchQuadric plainQuadric(const PatchSamples& samples, const CellMetric& metric) const;
  [[nodiscard]] PatchQuadric noisyQuadric(const PatchSamples& samples, const CellMetric& metric) const;
  /// The minimiser of a regular quadric within the bounds.
  [[nodiscard]] SolvedVertex minimize(const PatchQuadric& patch, const CellMetric& metric) const;
  [[nodiscard]] SolvedVertex solveClassical(const PatchQuadric& patch, const CellMetric& metric) const;
  void constrain(SolvedVertex& v, const NormalEquations<double>& system) const;

  SigmaNormal mSigma;
  double mHalfSize;
};

}  // namespace pdc::detail
