#pragma once

#include <atomic>
#include <chrono>
#include <string>

namespace pdc {

/// A bar on standard error, for a person: the share done, how fast it grows and how long the rest will take at that
/// rate. It is drawn only on a terminal and only once the work has taken more than a second, and wiped when the object
/// goes out of scope.
class ProgressBar {
 public:
  /// `wanted` false, or standard error not being a terminal, makes a bar that never draws.
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Serves as Monitor::progress: any thread may call it; draws at most ten times a second.
  void update(const char* stage, double share);

 private:
  using Clock = std::chrono::steady_clock;

  bool mEnabled;
  std::atomic<bool> mDrawn = false;
  std::atomic<Clock::rep> mNextDraw;
  // Where the stage began; stages come one after the other.
  std::atomic<const char*> mStage = nullptr;
  std::atomic<Clock::rep> mStageStart = 0;
  std::atomic<double> mStageShare = 0;
};

/// "12 %/s, 1:05 min left", for a share that grew by `gained` in `seconds`; empty while that says nothing.
[[nodiscard]] std::string progressRate(double gained, double seconds, double share);

}  // namespace pdc
