#pragma once

#include "math/lane_loops.h"
#include "sample/creases/distance_stencil.h"
#include "sample/stencils/value_reading.h"

namespace pdc::detail {

/// Values strictly between the two may enter a slope; others are clamped or not finite.
struct SlopeLimits {
  float low, high;
};

/// Finite even where nothing is clamped, so that infinite values are left out.
[[nodiscard]] SlopeLimits slopeLimits(const ValueReading& reading);

/// Scales the values that a slope may be made of, in the rows that were read, and makes the others NaN. \param level
/// changes no bit of it.
void scaleKnown(const SlopeLimits& limits, float scale, DistanceStencil& stencil, SimdLevel level = bestSimdLevel());

}  // namespace pdc::detail
