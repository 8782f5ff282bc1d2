#pragma once

#include <algorithm>
#include <cmath>

#include "pdc/math/box.h"

namespace pdc::detail {

/// What single precision makes of the coordinates of a file.
struct Narrowing {
  Box box = Box::empty();
  double largestError = 0;  ///< The most that a coordinate changes.

  void include(const Vec3d& p) {
    for (int axis = 0; axis < 3; ++axis) {
      // NaN is no smaller and no larger than anything, so it changes nothing here.
      box.lo[axis] = std::min(box.lo[axis], p[axis]);
      box.hi[axis] = std::max(box.hi[axis], p[axis]);
      largestError = std::max(largestError, std::abs(p[axis] - static_cast<double>(static_cast<float>(p[axis]))));
    }
  }
};

/// The most that single precision may change a coordinate, as a share of the box's largest side. Up to 16 sides away
/// from the origin it never changes one by more: its error is 2^-24 of the coordinate.
inline constexpr double kMostNarrowing = 1e-6;

/// What to subtract from all coordinates so that single precision serves: zero where it does already, where the box has
/// no size, or is not finite in single precision. Otherwise the box's middle, rounded to a multiple of a power of two
/// of about an eighth of the largest side, so that differences of numbers that single precision holds stay exact.
[[nodiscard]] Vec3d chooseOrigin(const Narrowing& narrowing);

}  // namespace pdc::detail
