#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pdc/math/mat3.h"
#include "pdc/math/simd_level.h"
#include "pdc/sample/hermite_block.h"
#include "sample/stencils/slope_limits.h"

namespace pdc::detail {

/// A block's points and their neighbours, points -1 to 9 on each axis, as values that are negative inside.
struct GradientStencil {
  static constexpr int kPoints = kBlockPoints + 2;
  static constexpr std::array<int, 3> kStep{kPoints * kPoints, kPoints, 1};

  /// The block that a point belongs to, along an axis: 0 the one below, 1 the block itself, 2 the one above.
  static constexpr int part(int x) { return x < 0 ? 0 : x < kBlockSize ? 1 : 2; }
  static constexpr int index(int x, int y, int z) { return (kPoints * (x + 1) + y + 1) * kPoints + z + 1; }

  std::array<float, kPoints * kPoints * kPoints> value;
};

/// The rows along z of a stencil that hold what a block's crossings need.
class GradientStencilRows {
 public:
  explicit GradientStencilRows(const EdgeIndex& edges);

  /// Row (x, y) is kPoints (x + 1) + y + 1.
  [[nodiscard]] std::span<const std::uint8_t> rows() const { return {mRow.data(), mSize}; }
  /// Bit 3 GradientStencil::part(x) + GradientStencil::part(y) is set if any row (x, y) of that part is needed.
  [[nodiscard]] unsigned parts() const { return mParts; }
  /// True if the points at z = -1 are needed.
  [[nodiscard]] bool below() const { return mBelow; }

 private:
  std::array<std::uint8_t, GradientStencil::kPoints * GradientStencil::kPoints> mRow;
  std::size_t mSize = 0;
  unsigned mParts = 0;
  bool mBelow = false;
};

/// Fills crossings and normals of a block from its points: the crossing where the linear function along the edge is
/// zero; as normal, `normalMap` times the gradient of the trilinear interpolant, averaged over the four cells there.
/// \param level changes no bit of it.
void fillFromStencil(const GradientStencil& stencil, const EdgeIndex& edges, const SlopeLimits& limits,
                     const Mat3<float>& normalMap, HermiteBlock& hermite, SimdLevel level = bestSimdLevel());

}  // namespace pdc::detail
