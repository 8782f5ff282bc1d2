#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace pdc::detail {

/// Values as near as this to the end of a band, relative to it, stand for all beyond.
inline constexpr double kAtBandEnd = 1e-3;

/// The least and the largest of finite values; low > high if there were none.
struct ValueRange {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double v) {
    if (!std::isfinite(v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  void add(const ValueRange& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
};

}  // namespace pdc::detail
