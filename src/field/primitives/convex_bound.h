#pragma once

#include <algorithm>

#include "field/interval_arithmetic.h"
#include "field/pointwise_field.h"

namespace pdc::detail {

/// The range of a convex function over a box, without room for rounding: the function is largest at a corner, and lies
/// above its tangent at the centre. Distances to convex solids are convex.
template <typename Function>
Interval convexBound(const Function& function, const Box& box) {
  const ValueGradient tangent = function.gradient(box.center());
  Interval range{tangent.value - extent(box, tangent.gradient), tangent.value};
  for (int i = 0; i < 8; ++i) range.hi = std::max(range.hi, function.value(corner(box, i)));
  return range;
}

}  // namespace pdc::detail
