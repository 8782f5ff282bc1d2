#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>

#include "pdc/monitor.h"

namespace pdc::detail {

/// Reports a stage of rounds to a Monitor. How many there will be is not known, so each counts as half of what is left
/// of the stage. The share reported never goes back.
class RoundProgress {
 public:
  RoundProgress(const Monitor& monitor, const char* stage) : mMonitor(monitor), mStage(stage) {}

  [[nodiscard]] const Monitor& monitor() const { return mMonitor; }
  /// Ends the round before. \throws Cancelled.
  void beginRound(std::size_t steps) {
    mMonitor.throwIfStopped();
    mBegin = mEnd;
    mEnd = 0.5 * (mBegin + 1);
    mSteps = steps;
    mDone = 0;
    report(mBegin);
  }
  /// Notes that a step of the round is done. Called from many threads. \throws Cancelled.
  void advance() {
    mMonitor.throwIfStopped();
    if (!mMonitor.progress) return;
    const std::size_t done = mDone.fetch_add(1, std::memory_order_relaxed) + 1;
    if (done % kStepsPerReport == 0)
      report(mBegin + (mEnd - mBegin) * static_cast<double>(done) / static_cast<double>(mSteps));
  }
  void finish() { report(1); }

 private:
  static constexpr std::size_t kStepsPerReport = 256;

  /// Under a lock: a thread that counted earlier may report later.
  void report(double share) {
    if (!mMonitor.progress) return;
    const std::lock_guard lock(mMutex);
    if (share < mReported) return;
    mReported = share;
    mMonitor.progress(mStage, share);
  }

  const Monitor& mMonitor;
  const char* mStage;
  double mBegin = 0, mEnd = 0;  ///< Shares of the stage where the round begins and ends.
  std::size_t mSteps = 0;
  std::atomic<std::size_t> mDone{0};  ///< Steps of the round.
  std::mutex mMutex;
  double mReported = 0;
};

}  // namespace pdc::detail
