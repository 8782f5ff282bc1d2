#include "sample/stencils/slope_limits.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "math/float_lanes.h"

namespace pdc::detail {

SlopeLimits slopeLimits(const ValueReading& reading) {
  constexpr double kMostClamp = 1e38;  // A slope of larger values may not fit into single precision.
  const double clamp = std::min(reading.clamp, kMostClamp);
  const double iso = reading.insideIsHigher ? -reading.iso : reading.iso;
  const double low = -clamp - iso, high = clamp - iso;
  return {static_cast<float>(low + 1e-6 * std::abs(low)), static_cast<float>(high - 1e-6 * std::abs(high))};
}

void scaleKnown(const SlopeLimits& limits, float scale, DistanceStencil& stencil, SimdLevel level) {
  withSimd(level, [&stencil, scale, low = limits.low, high = limits.high] {
    constexpr int kEight = sizeof(Float8) / sizeof(float);
    const Float8 unknown = Float8{} + std::numeric_limits<float>::quiet_NaN();
    for (int x = 0; x < DistanceStencil::kPoints; ++x)
      for (unsigned rows = stencil.rows[x]; rows != 0; rows &= rows - 1) {
        float* row = &stencil.value[(DistanceStencil::kPoints * x + std::countr_zero(rows)) * kLanes];
        // In vectors, as g++ unrolls a loop over so few lanes before it can vectorise it.
        for (int lane = 0; lane < kLanes; lane += kEight) {
          Float8 v;
          std::memcpy(&v, row + lane, sizeof v);
          v = ((v > low) & (v < high)) ? v * scale : unknown;
          std::memcpy(row + lane, &v, sizeof v);
        }
      }
  });
}

}  // namespace pdc::detail
