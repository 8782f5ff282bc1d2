#pragma once

#include <algorithm>
#include <cmath>

#include "pdc/math/box.h"
#include "pdc/math/interval.h"

/// The interval arithmetic that bounds of fields are made of. Nothing here rounds outwards: a bound ends with
/// widened().
namespace pdc::detail {

/// Relative room for rounding in a bound: thousands of times what a field's own arithmetic loses.
inline constexpr double kRoundingSlack = 1e-12;

/// Sizes below this, and their inverses, can be multiplied with each other a few times without overflow.
inline constexpr double kUsual = 1e30;

/// The range with room for the rounding of a value computed from numbers up to `magnitude`; whole() for NaN.
inline Interval widened(Interval range, double magnitude) {
  const Interval wide{range.lo - kRoundingSlack * (magnitude + std::abs(range.lo)),
                      range.hi + kRoundingSlack * (magnitude + std::abs(range.hi))};
  return wide.lo <= wide.hi ? wide : Interval::whole();
}

/// The bound that follows from the value at the box's centre and a constant that limits the slope.
inline Interval lipschitzBound(double atCenter, double slope, const Box& box) {
  if (!std::isfinite(atCenter)) return Interval::whole();
  const double reach = slope * box.radius();
  return widened({atCenter - reach, atCenter + reach}, slope * largestEntry(box));
}

/// The range that holds a function's values if both ranges do.
inline Interval intersection(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)}; }
/// The smallest range that holds both.
inline Interval hull(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }

inline Interval around(double center, double radius) { return {center - radius, center + radius}; }

inline Interval sum(Interval a, Interval b) { return {a.lo + b.lo, a.hi + b.hi}; }
inline Interval difference(Interval a, Interval b) { return {a.lo - b.hi, a.hi - b.lo}; }
inline Interval product(Interval a, Interval b) {
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  return {std::min({p, q, r, s}), std::max({p, q, r, s})};
}
inline Interval product(Interval a, double notNegative) { return {a.lo * notNegative, a.hi * notNegative}; }
inline Interval absolute(Interval a) {
  return {std::max({0.0, a.lo, -a.hi}), std::max(std::abs(a.lo), std::abs(a.hi))};
}

/// Smallest and largest |p - center| per axis over the box.
struct AxisDistances {
  Vec3d near, far;

  AxisDistances(const Box& box, const Vec3d& center) {
    for (int i = 0; i < 3; ++i) {
      const Interval d = absolute({box.lo[i] - center[i], box.hi[i] - center[i]});
      near[i] = d.lo;
      far[i] = d.hi;
    }
  }
};

/// Largest |direction · (p - centre of the box)| over the box.
inline double extent(const Box& box, const Vec3d& direction) {
  const Vec3d h = box.halfSize();
  return std::abs(direction.x) * h.x + std::abs(direction.y) * h.y + std::abs(direction.z) * h.z;
}

inline Vec3d corner(const Box& box, int i) {
  return {(i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y, (i & 4) != 0 ? box.hi.z : box.lo.z};
}

}  // namespace pdc::detail
