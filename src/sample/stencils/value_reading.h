#pragma once

namespace pdc::detail {

/// How sampled values are read as a function that is negative inside.
struct ValueReading {
  double iso = 0;
  bool insideIsHigher = false;
  bool open = false;
  bool acceptNonFinite = false;
  /// The values are clamped distances: those this far from zero carry no slope. Infinite for others.
  double clamp = 0;
};

}  // namespace pdc::detail
