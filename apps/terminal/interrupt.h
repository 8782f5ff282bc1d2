#pragma once

#include <atomic>
#include <string_view>

namespace pdc {

/// Exit code of work that was interrupted, by SIGINT or SIGTERM alike.
inline constexpr int kInterruptedExitCode = 130;
/// What such a program says last, on standard error.
inline constexpr std::string_view kInterruptedMessage = "pdc: interrupted\n";

/// Takes SIGINT and SIGTERM. The first one sets interruptFlag(); a second one ends the process at once, with
/// kInterruptedExitCode and without the temporary files of unfinished output.
void installInterruptHandler();

/// True once a signal has come; serves as Monitor::stop.
[[nodiscard]] const std::atomic<bool>& interruptFlag();

/// While one lives the first signal ends the process at once too: for work that cannot be asked to stop, such as
/// OpenVDB's reading, and for writing. \throws Cancelled when made after a signal.
class ExitOnInterrupt {
 public:
  ExitOnInterrupt();
  ~ExitOnInterrupt();
  ExitOnInterrupt(const ExitOnInterrupt&) = delete;
  ExitOnInterrupt& operator=(const ExitOnInterrupt&) = delete;
};

}  // namespace pdc
