#include "terminal/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <string>

namespace pdc {
namespace {

constexpr int kWidth = 30;
constexpr auto kFirstDraw = std::chrono::seconds(1);
constexpr auto kBetweenDraws = std::chrono::milliseconds(100);

// One call per picture, so that pictures from two threads do not mix. A bar that cannot be drawn is no error.
void show(const std::string& text) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace

std::string progressRate(double gained, double seconds, double share) {
  constexpr double kShortest = 0.2;  // seconds
  if (!(gained > 0) || seconds < kShortest) return "";
  const double rate = gained / seconds, left = (1 - share) / rate;
  const int whole = static_cast<int>(std::min(left + 0.5, 359999.0));
  const std::string rest =
      whole < 60 ? fmt::format("{} s", whole) : fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format(", {:.2g} %/s, {} left", 100 * rate, rest);
}

ProgressBar::ProgressBar(bool wanted)
    : mEnabled(wanted && ::isatty(STDERR_FILENO) == 1),
      mNextDraw((Clock::now() + kFirstDraw).time_since_epoch().count()) {}

ProgressBar::~ProgressBar() {
  if (mDrawn) show("\r\033[K");
}

void ProgressBar::update(const char* stage, double share) {
  if (!mEnabled) return;
  const auto now = Clock::now();
  if (mStage.load(std::memory_order_relaxed) != stage && mStage.exchange(stage) != stage) {
    mStageStart = now.time_since_epoch().count();
    mStageShare = share;
  }
  auto due = mNextDraw.load(std::memory_order_relaxed);
  if (now.time_since_epoch().count() < due) return;
  const auto next = (now + kBetweenDraws).time_since_epoch().count();
  // Whoever moves the date draws; the others go back to work.
  if (!mNextDraw.compare_exchange_strong(due, next)) return;
  mDrawn = true;
  const double done = std::clamp(share, 0.0, 1.0);
  const int filled = static_cast<int>(done * kWidth);
  const std::chrono::duration<double> passed = now.time_since_epoch() - Clock::duration(mStageStart);
  show(fmt::format("\r\033[K[{:=<{}}{: <{}}] {:3.0f} % {}{}", "", filled, "", kWidth - filled, 100 * done, stage,
                   progressRate(done - mStageShare, passed.count(), done)));
}

}  // namespace pdc
