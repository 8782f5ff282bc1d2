#pragma once

#include <algorithm>
#include <limits>

#include "pdc/math/vec3.h"

namespace pdc {

/// An axis-aligned box with its border, lo <= hi on every axis; or empty(). Coordinates are not NaN.
template <typename T>
struct BasicBox {
  Vec3<T> lo, hi;

  /// The box that holds nothing and grows by what it is made to include: from +infinity to -infinity.
  static constexpr BasicBox empty() {
    constexpr T kInfinity = std::numeric_limits<T>::infinity();
    return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  }

  [[nodiscard]] constexpr bool isEmpty() const { return lo.x > hi.x; }
  [[nodiscard]] constexpr Vec3<T> center() const { return (lo + hi) * T(0.5); }
  [[nodiscard]] constexpr Vec3<T> halfSize() const { return (hi - lo) * T(0.5); }
  /// Distance from the centre to a corner.
  [[nodiscard]] T radius() const { return length(halfSize()); }

  /// Grows to hold another box as well.
  constexpr void include(const BasicBox& o) {
    lo = {std::min(lo.x, o.lo.x), std::min(lo.y, o.lo.y), std::min(lo.z, o.lo.z)};
    hi = {std::max(hi.x, o.hi.x), std::max(hi.y, o.hi.y), std::max(hi.z, o.hi.z)};
  }
  constexpr void include(const Vec3<T>& p) { include(BasicBox{p, p}); }
  /// Whether the boxes have a point in common.
  [[nodiscard]] constexpr bool meets(const BasicBox& o) const {
    return lo.x <= o.hi.x && o.lo.x <= hi.x && lo.y <= o.hi.y && o.lo.y <= hi.y && lo.z <= o.hi.z && o.lo.z <= hi.z;
  }
  /// The square of the distance from a point; 0 inside.
  [[nodiscard]] constexpr double squaredDistance(const Vec3d& p) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double beyond = std::max({double(lo[k]) - p[k], p[k] - double(hi[k]), 0.0});
      sum += beyond * beyond;
    }
    return sum;
  }
  friend constexpr bool operator==(const BasicBox&, const BasicBox&) = default;
  /// The largest size of a coordinate of its points. The box must not be empty.
  friend T largestEntry(const BasicBox& box) { return std::max(largestEntry(box.lo), largestEntry(box.hi)); }
};

using Box = BasicBox<double>;
using BoxF = BasicBox<float>;

}  // namespace pdc
