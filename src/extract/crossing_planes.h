#pragma once

#include <array>

#include "extract/vertex_solver.h"
#include "math/float_lanes.h"
#include "pdc/math/simd_level.h"
#include "pdc/sample/hermite_source.h"

namespace pdc::detail {

/// The crossings of one block in lattice units: the row r = Mᵀn of the crossing's plane (see PatchSamples) and the
/// place t from the low end of its edge.
class CrossingPlanes {
 public:
  /// \param level changes no bit of it. \returns how many of the block's own edges have no normal.
  std::size_t fill(const HermiteBlock& hermite, const EdgeIndex& edges, const CellMetric& metric, const LatticeMap& map,
                   const Vec3d& origin, SimdLevel level);
  /// Keeps the noise of the crossings. \param variance of all normals, besides.
  void setNoise(const PlaneNoise& noise, const EdgeIndex& edges, double variance);
  /// Weights below count as this, so that crossings without any do not leave a cell without a place.
  static constexpr float kLeastWeight = 1e-6F;

  /// (r, t) of edge i in row i + 1; the first is zero.
  [[nodiscard]] const float* row(std::size_t i) const { return mRow[i].data(); }
  /// (weight, weight times variance) of edge i in row i + 1; the first is zero.
  [[nodiscard]] const float* noise(std::size_t i) const { return mNoise[i].data(); }
  [[nodiscard]] Vec3f plane(int edge) const { return {mRow[edge + 1][0], mRow[edge + 1][1], mRow[edge + 1][2]}; }
  [[nodiscard]] float t(int edge) const { return mRow[edge + 1][3]; }

 private:
  using Rows = std::array<std::array<float, 4>, HermiteBlock::kCapacity + 1>;

  alignas(16) Rows mRow;
  alignas(16) Rows mNoise;
};

}  // namespace pdc::detail
