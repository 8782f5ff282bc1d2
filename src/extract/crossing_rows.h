#pragma once

#include <array>

#include "extract/float_lanes.h"
#include "extract/vertex_solver.h"
#include "pdc/math/simd_level.h"
#include "pdc/sample/hermite_source.h"

namespace pdc::detail {

/// What the crossings of one block add to the sums of the cells about their edges, in lattice units.
///
/// With the plane's row r = Mᵀn (see PatchSamples), the crossing p from the block's origin and its place t from the low
/// end of its edge along axis a, one row holds (r r₀, p₀, r r₁, p₁, r r₂, p₂, r (t rₐ), 1): a cache line. Where the
/// noise of each crossing is known, rrᵀ + Σn stands for rrᵀ, and all of the row is times the crossing's weight.
class CrossingRows {
 public:
  /// \param level changes no bit of it. \returns how many of the block's own edges have no normal.
  std::size_t fill(const HermiteBlock& hermite, const EdgeIndex& edges, const CellMetric& metric, const LatticeMap& map,
                   const Vec3d& origin, SimdLevel level);
  /// Weights below count as this, so that crossings without any do not leave a cell without a place.
  static constexpr float kLeastWeight = 1e-6F;
  /// Makes rows of fill() those of crossings with noise. \param variance of all normals, besides.
  void addNoise(const PlaneNoise& noise, const HermiteBlock& hermite, const EdgeIndex& edges, const CellMetric& metric,
                double variance);

  /// That of edge i at i + 1; the first is zero.
  [[nodiscard]] const Float16* rows() const { return mRow.data(); }
  /// r and p of edge i.
  [[nodiscard]] Vec3f plane(int i) const { return {mPlane[i][0], mPlane[i][1], mPlane[i][2]}; }
  [[nodiscard]] Vec3f place(int i) const {
    const Float16& row = mRow[i + 1];
    return {row[3] / row[15], row[7] / row[15], row[11] / row[15]};
  }

 private:
  std::array<Float16, EdgeIndex::kMaxEdges + 1> mRow;
  std::array<Float4, EdgeIndex::kMaxEdges> mPlane;
};

}  // namespace pdc::detail
