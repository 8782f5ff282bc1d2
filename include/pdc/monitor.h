#pragma once

#include <atomic>
#include <functional>

#include "pdc/error.h"

namespace pdc {

/// How a caller watches and stops long work. Both members are optional and are used from worker threads.
struct Monitor {
  /// Called with the name of the stage and the share of it done, in [0, 1]. Must be thread-safe and quick.
  std::function<void(const char* stage, double share)> progress{};
  /// When it becomes true the work stops within a block's time and throws Cancelled.
  const std::atomic<bool>* stop = nullptr;

  [[nodiscard]] bool stopped() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
  void throwIfStopped() const {
    if (stopped()) throw Cancelled();
  }
};

}  // namespace pdc
