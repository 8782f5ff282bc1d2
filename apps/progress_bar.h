#pragma once

#include <atomic>
#include <chrono>

namespace pdc {

/// A bar on standard error, for a person: drawn only on a terminal, only once the work has taken more than a second,
/// and wiped when the bar goes out of scope.
class ProgressBar {
 public:
  /// `wanted` false, or standard error not being a terminal, makes a bar that never draws.
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// For Monitor::progress: callable from any thread; draws at most ten times a second.
  void update(const char* stage, double share);

 private:
  using Clock = std::chrono::steady_clock;

  bool mEnabled;
  std::atomic<bool> mDrawn = false;
  std::atomic<Clock::rep> mNextDraw;
};

}  // namespace pdc
