#include "terminal/busy_sign.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <utility>

namespace pdc {
namespace {

// A sign that cannot be drawn is no error.
void show(const std::string& text) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

void drawEverySecond(const std::stop_token& stop, const std::string& what) {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);
  int seconds = 0;
  while (!wake.wait_for(lock, stop, std::chrono::seconds(1), [&] { return stop.stop_requested(); }))
    show(fmt::format("\r\033[K{}, {} s", what, ++seconds));
  if (seconds > 0) show("\r\033[K");
}

}  // namespace

BusySign::BusySign(bool wanted, std::string what) {
  if (!wanted || ::isatty(STDERR_FILENO) != 1) return;
  mThread = std::jthread([what = std::move(what)](const std::stop_token& stop) { drawEverySecond(stop, what); });
}

BusySign::~BusySign() = default;

}  // namespace pdc
