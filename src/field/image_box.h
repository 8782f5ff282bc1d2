#pragma once

#include <cmath>

#include "field/interval_arithmetic.h"
#include "pdc/math/mat3.h"

namespace pdc::detail {

/// The smallest box about the image of `box` under p ↦ linear · (p - origin), with room for rounding.
inline Box imageBox(const Mat3d& linear, const Vec3d& origin, const Box& box) {
  // Many times what a few additions and multiplications lose.
  constexpr double kRounding = 1e-14;
  const Vec3d center = linear * (box.center() - origin);
  const double size = largestEntry(box) + largestEntry(origin);
  Vec3d half;
  for (int i = 0; i < 3; ++i) {
    const Vec3d& row = linear.row[i];
    half[i] = extent(box, row) + kRounding * size * (std::abs(row.x) + std::abs(row.y) + std::abs(row.z));
  }
  return {center - half, center + half};
}

}  // namespace pdc::detail
