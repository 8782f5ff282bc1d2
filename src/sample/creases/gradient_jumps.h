#pragma once

#include <array>
#include <bitset>
#include <cmath>
#include <cstdint>

#include "pdc/math/simd_level.h"
#include "sample/creases/distance_stencil.h"

namespace pdc::detail {

/// A second difference to correct a one-sided slope with: of the two at its ends the smaller, or the known one.
inline float milder(float a, float b) {
  float mild = std::abs(a) < std::abs(b) ? a : b;
  mild = mild == mild ? mild : a;
  return mild == mild ? mild : 0.0F;
}

/// Slopes at a point of a stencil along one axis, from above and below, exact to second order where the function is
/// smooth on their side (ENO, Harten & Osher 1987). NaN where unknown.
struct OneSidedSlopes {
  OneSidedSlopes(const float* p, int step) {
    const float up = p[step] - p[0], down = p[0] - p[-step], bend = up - down;
    const float bendUp = p[2 * step] - 2 * p[step] + p[0], bendDown = p[0] - 2 * p[-step] + p[-2 * step];
    above = up - 0.5F * milder(bend, bendUp);
    below = down + 0.5F * milder(bend, bendDown);
  }
  float below, above;
};

/// The points of a block whose slopes from both sides are known and differ along some axis: a crease's bisector passes
/// by. Found a row at a time, as they are asked for.
class GradientJumps {
 public:
  /// \param stencil must outlive this. \param tolerance by how much slopes may differ. \param level changes no bit of
  /// it.
  GradientJumps(const DistanceStencil& stencil, float tolerance, SimdLevel level = bestSimdLevel())
      : mStencil(stencil), mTolerance(tolerance), mLevel(level) {}

  /// True if there are none at the corners of a cell. A bisector that passes between them is next to one.
  [[nodiscard]] bool noneAt(const Coord& cell);

 private:
  void find(int row);

  const DistanceStencil& mStencil;
  float mTolerance;
  SimdLevel mLevel;
  std::bitset<kBlockPoints * kBlockPoints> mKnown;
  std::array<std::uint16_t, kBlockPoints * kBlockPoints> mRow;  ///< By 9x + y; bit z.
};

}  // namespace pdc::detail
