#pragma once

#include <algorithm>
#include <limits>

namespace pdc {

/// A closed range of values that is guaranteed to hold a function's values over a box. lo <= hi.
struct Interval {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();

  /// Nothing is known.
  static constexpr Interval whole() { return {}; }

  [[nodiscard]] constexpr bool contains(double v) const { return lo <= v && v <= hi; }
  [[nodiscard]] constexpr bool bounded() const {
    return lo > -std::numeric_limits<double>::infinity() && hi < std::numeric_limits<double>::infinity();
  }
  friend constexpr Interval operator+(Interval a, double s) { return {a.lo + s, a.hi + s}; }
  friend constexpr Interval operator-(Interval a) { return {-a.hi, -a.lo}; }
};

constexpr Interval min(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)}; }
constexpr Interval max(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)}; }

}  // namespace pdc
