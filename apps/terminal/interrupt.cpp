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

[[noreturn]] void exitAtOnce() {
  detail::removeTemporaryFiles();
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kInterruptedMessage.data(), kInterruptedMessage.size());
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
