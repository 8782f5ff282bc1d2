#pragma once

#include <cmath>

/// Slopes of sampled values along one axis of a lattice, per step. Neighbours are `step` apart in memory.
namespace pdc::detail {

/// The central difference at p.
inline float centralSlope(const float* p, int step) { return 0.5F * (p[step] - p[-step]); }

/// The second difference that a one-sided slope is corrected with: the smaller of those at its ends, or the known one.
inline float smallerBend(float a, float b) {
  float bend = std::abs(a) < std::abs(b) ? a : b;
  bend = bend == bend ? bend : a;
  return bend == bend ? bend : 0.0F;
}

/// Slopes at p from above and below, exact to second order where the function is smooth on their side (ENO, Harten &
/// Osher 1987). NaN where unknown.
struct OneSidedSlopes {
  OneSidedSlopes(const float* p, int step) {
    const float up = p[step] - p[0], down = p[0] - p[-step], bend = up - down;
    const float bendUp = p[2 * step] - 2 * p[step] + p[0], bendDown = p[0] - 2 * p[-step] + p[-2 * step];
    above = up - 0.5F * smallerBend(bend, bendUp);
    below = down + 0.5F * smallerBend(bend, bendDown);
  }
  float below, above;
};

}  // namespace pdc::detail
