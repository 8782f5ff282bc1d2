#pragma once

#include <algorithm>
#include <limits>

namespace pdc {

/// A closed range [lo, hi] that is guaranteed to hold a function's values over a box. Infinite ends say that nothing is
/// known. lo <= hi, neither of them NaN; nobody checks. Operations work on the ends as they are and do not round
/// outwards: where a guarantee needs room for rounding, whoever makes the range adds it.
struct Interval {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();

  /// All numbers: nothing is known.
  static constexpr Interval whole() { return {}; }

  /// False for NaN.
  [[nodiscard]] constexpr bool contains(double v) const { return lo <= v && v <= hi; }
  /// Whether both ends are finite.
  [[nodiscard]] constexpr bool bounded() const {
    return lo > -std::numeric_limits<double>::infinity() && hi < std::numeric_limits<double>::infinity();
  }
  friend constexpr Interval operator+(Interval a, double s) { return {a.lo + s, a.hi + s}; }
  friend constexpr Interval operator-(Interval a) { return {-a.hi, -a.lo}; }
};

/// The range of the smaller of two values, one from each range.
constexpr Interval min(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)}; }
/// The range of the larger of two values, one from each range.
constexpr Interval max(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)}; }

}  // namespace pdc
