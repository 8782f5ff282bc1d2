#pragma once

#include <cmath>

#include "pdc/math/vec3.h"

namespace pdc::detail {

/// The point on the lattice of multiples of a step > 0 that is nearest to p.
inline Vec3d nearestMultiple(const Vec3d& p, double step) {
  return {std::nearbyint(p.x / step) * step, std::nearbyint(p.y / step) * step, std::nearbyint(p.z / step) * step};
}

}  // namespace pdc::detail
