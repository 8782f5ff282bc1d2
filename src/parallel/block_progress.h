#pragma once

#include <atomic>
#include <cstddef>

#include "pdc/monitor.h"

namespace pdc::detail {

/// Counts finished blocks of one stage for a Monitor, and is where workers notice that they should stop.
class BlockProgress {
 public:
  BlockProgress(const Monitor& monitor, const char* stage, std::size_t total)
      : mMonitor(monitor), mStage(stage), mTotal(total) {
    monitor.throwIfStopped();
  }

  /// \throws Cancelled.
  void advance(std::size_t blocks) {
    mMonitor.throwIfStopped();
    if (!mMonitor.progress) return;
    const std::size_t done = mDone.fetch_add(blocks, std::memory_order_relaxed) + blocks;
    mMonitor.progress(mStage, static_cast<double>(done) / static_cast<double>(mTotal));
  }

 private:
  const Monitor& mMonitor;
  const char* mStage;
  std::size_t mTotal;
  std::atomic<std::size_t> mDone{0};
};

}  // namespace pdc::detail
