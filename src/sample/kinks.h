#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "pdc/math/simd_level.h"
#include "sample/distance_window.h"

namespace pdc::detail {

/// A second difference to correct a one-sided slope with: of the two at its ends the smaller, or the known one.
inline float milder(float a, float b) {
  const float known = a == a ? a : b == b ? b : 0.0F;
  return std::abs(b) <= std::abs(a) ? b : known;
}

/// Slopes at a point of a window along one axis, from above and below, exact to second order where the function is
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

/// The voxels of a block and about it, -1 to 9 on each axis, whose slopes from both sides are known and differ along
/// some axis: a crease's bisector passes by.
class Kinks {
 public:
  /// True if there are none in the 4×4×4 voxels about a cell.
  [[nodiscard]] bool noneAbout(const Coord& cell) const {
    unsigned any = 0;
    for (int x = 0; x < 4; ++x)
      for (int y = 0; y < 4; ++y) any |= mRow[kVoxels * (cell[0] + x) + cell[1] + y];
    return (any >> cell[2] & 15) == 0;
  }

 private:
  static constexpr int kVoxels = kBlockPoints + 2;
  friend Kinks findKinks(const DistanceWindow& window, float tolerance, SimdLevel level);
  std::array<std::uint16_t, kVoxels * kVoxels> mRow;  ///< By 11 (x + 1) + y + 1; bit z + 1.
};

/// \param tolerance by how much slopes may differ. \param level changes no bit of it.
[[nodiscard]] Kinks findKinks(const DistanceWindow& window, float tolerance, SimdLevel level = bestSimdLevel());

}  // namespace pdc::detail
