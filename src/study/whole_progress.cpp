#include "study/whole_progress.h"

#include <algorithm>

namespace pdc::detail {

Monitor WholeProgress::beginPart() {
  mWhole.throwIfStopped();
  mStage.clear();
  mStageEnd = static_cast<double>(mBegun++) / static_cast<double>(mParts);
  if (!mWhole.progress) return {.stop = mWhole.stop};
  return {.progress = [this](const char* stage, double share) { report(stage, share); }, .stop = mWhole.stop};
}

void WholeProgress::finish() {
  mWhole.throwIfStopped();
  if (mWhole.progress) mWhole.progress("done", 1);
}

void WholeProgress::report(const char* stage, double share) {
  // The caller's function runs under the lock, so that what it hears is in order. Nobody waits for a report.
  const std::unique_lock lock(mMutex, std::try_to_lock);
  if (!lock) return;
  if (mStage != stage) {
    const double partEnd = static_cast<double>(mBegun) / static_cast<double>(mParts);
    mStage = stage;
    mStageBegin = mStageEnd;
    mStageEnd += (partEnd - mStageEnd) / 2;
  }
  const double shown = mStageBegin + std::clamp(share, 0.0, 1.0) * (mStageEnd - mStageBegin);
  if (shown <= mShown) return;
  mShown = shown;
  mWhole.progress(stage, shown);
}

}  // namespace pdc::detail
