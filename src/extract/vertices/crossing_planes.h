#pragma once

#include <array>

#include "extract/vertices/cell_metric.h"
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

  /// (r, t) of an edge.
  [[nodiscard]] const float* row(int edge) const { return mRow[edge].data(); }
  /// (weight, weight times variance) of an edge.
  [[nodiscard]] const float* noise(int edge) const { return mNoise[edge].data(); }
  [[nodiscard]] Vec3f plane(int edge) const { return {mRow[edge][0], mRow[edge][1], mRow[edge][2]}; }
  [[nodiscard]] float t(int edge) const { return mRow[edge][3]; }

 private:
  alignas(16) std::array<std::array<float, 4>, HermiteBlock::kCapacity> mRow;
  std::array<std::array<float, 2>, HermiteBlock::kCapacity> mNoise;
};

}  // namespace pdc::detail
