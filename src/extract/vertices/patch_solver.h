#pragma once

#include <array>
#include <optional>
#include <vector>

#include "extract/vertices/block_sampler.h"
#include "extract/vertices/crossing_planes.h"
#include "extract/vertices/vertex_solver.h"

namespace pdc::detail {

/// Where a vertex goes that is promised to lie in its cell or to be certified later.
struct CellPlacement {
  Vec3f place;                  ///< In lattice units from the centre of the cell.
  std::optional<Vec3f> safe{};  ///< For a suspect vertex: see SuspectVertex.
};

/// Solves single patches in double precision: those that a batch of lanes leaves over. For one thread.
class PatchSolver {
 public:
  /// All three must outlive this.
  PatchSolver(const BlockSampler& sampler, const CrossingPlanes& crossings, const VertexSolver& solver);

  /// Loads a patch of the block that was sampled last.
  void load(std::size_t patch, const EdgeIndex& edges);

  [[nodiscard]] const PatchSamples& samples() const { return mSamples; }
  [[nodiscard]] SolvedVertex solve(const CellMetric& metric) const { return mSolver.solve(mSamples, metric); }

  /// Puts the loaded patch's vertex, whose free place is `x`, into its cell where that costs nothing; otherwise it is
  /// suspect and stays. \param ambiguous whether not every place in the cell is safe. \param cellHalfSize see
  /// roundedCellHalfSize().
  [[nodiscard]] CellPlacement placeInCell(const Vec3d& x, bool ambiguous, double cellHalfSize,
                                          const CellMetric& metric) const;

  /// The normals, in world space, of the planes that meet in a crease at a vertex whose free place is `x`, where that
  /// is known; zero beyond the last.
  [[nodiscard]] std::array<Vec3f, 4> creaseNormals(const Vec3d& x, const CellMetric& metric) const;

 private:
  [[nodiscard]] Vec3d innerMassPoint() const;

  const BlockSampler& mSampler;
  const CrossingPlanes& mCrossings;
  const VertexSolver& mSolver;
  const bool mExactNormals;
  PatchSamples mSamples;
  std::array<Axis, PatchSamples::kMax> mAxis;   ///< The samples' edges'.
  std::vector<FeaturePlanes::Plane> mFeatures;  ///< About the centre of the cell.
};

}  // namespace pdc::detail
