#pragma once

#include <cstddef>
#include <mutex>
#include <string>

#include "pdc/monitor.h"

namespace pdc::detail {

/// Turns what the parts of some work report, one part after the other, into the progress of the whole. A part may have
/// any number of stages, each of which counts from 0 to 1, and report from many threads: what the whole's monitor hears
/// never falls. How many stages come is not known, so each gets half of what is left of its part.
class WholeProgress {
 public:
  /// `whole` must live as long as this.
  WholeProgress(const Monitor& whole, std::size_t parts) : mWhole(whole), mParts(parts) {}

  /// Ends the part before and begins the next one. \returns its monitor, to be used until the next call. \throws
  /// Cancelled.
  [[nodiscard]] Monitor beginPart();
  /// Ends the last part: reports 1. \throws Cancelled.
  void finish();

 private:
  void report(const char* stage, double share);

  const Monitor& mWhole;
  std::size_t mParts, mBegun = 0;
  std::mutex mMutex;
  std::string mStage;
  double mStageBegin = 0, mStageEnd = 0;
  double mShown = -1;
};

}  // namespace pdc::detail
