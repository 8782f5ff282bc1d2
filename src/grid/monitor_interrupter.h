#pragma once

#include <openvdb/util/NullInterrupter.h>

#include <algorithm>
#include <atomic>

#include "pdc/monitor.h"

namespace pdc::detail {

/// Shows a Monitor what OpenVDB's tools tell their interrupter. A tool is stopped by the exception: one that is told
/// to stop returns as if it had finished.
class MonitorInterrupter final : public openvdb::util::NullInterrupter {
 public:
  /// \param starts how often the tool calls start(), from which the share done is counted; 0 where it says percents.
  MonitorInterrupter(const Monitor& monitor, const char* stage, int starts = 0)
      : mMonitor(monitor), mStage(stage), mStarts(starts) {
    show(0);
  }

  void start(const char* /*name*/ = nullptr) override {
    if (mStarts > 0) show(static_cast<double>(mDone++) / mStarts);
  }
  bool wasInterrupted(int percent = -1) override {
    mMonitor.throwIfStopped();
    if (mStarts == 0 && percent >= 0) show(percent / 1e2);
    return false;
  }

 private:
  void show(double share) {
    mMonitor.throwIfStopped();
    if (mMonitor.progress) mMonitor.progress(mStage, std::clamp(share, 0.0, 1.0));
  }

  const Monitor& mMonitor;
  const char* mStage;
  int mStarts;
  std::atomic<int> mDone = 0;
};

}  // namespace pdc::detail
