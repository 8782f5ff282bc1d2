#pragma once

#include <chrono>

namespace pdc::detail {

/// Wall-clock time in seconds since it was made or last asked.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> passed = now - mLast;
    mLast = now;
    return passed.count();
  }

 private:
  std::chrono::steady_clock::time_point mLast = std::chrono::steady_clock::now();
};

}  // namespace pdc::detail
