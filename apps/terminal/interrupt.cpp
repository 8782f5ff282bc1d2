#include "terminal/interrupt.h"

#include <unistd.h>

#include <csignal>

#include "io/file/temporary_files.h"
#include "pdc/error.h"

namespace pdc {
namespace {

std::atomic<bool> gInterrupted = false;
std::atomic<int> gExitScopes = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void show(std::string_view text) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

[[noreturn]] void exitAtOnce() {
  detail::removeTemporaryFiles();
  // Nobody else wipes a bar that stands there.
  if (::isatty(STDERR_FILENO) == 1) show("\r\033[K");
  show(kInterruptedMessage);
  ::_exit(kInterruptedExitCode);
}

void onSignal(int /*signal*/) {
  const bool second = gInterrupted.exchange(true);
  if (second || gExitScopes > 0) exitAtOnce();
}

}  // namespace

void installInterruptHandler() {
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& interruptFlag() { return gInterrupted; }

ExitOnInterrupt::ExitOnInterrupt() {
  ++gExitScopes;
  if (gInterrupted) {
    --gExitScopes;
    throw Cancelled();
  }
}

ExitOnInterrupt::~ExitOnInterrupt() { --gExitScopes; }

}  // namespace pdc
