#pragma once

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <string>
#include <string_view>

#include "pdc/error.h"

#ifdef PDC_SANITIZED
#include <sanitizer/common_interface_defs.h>
extern "C" [[gnu::weak]] const char* __asan_get_report_description();
#endif

namespace pdc {

/// What became of many attempts, in child processes.
struct ForkedResult {
  std::size_t successes = 0, errors = 0;  ///< Attempts that returned, and that threw Error.
  std::string failure;       ///< The first attempt that ended otherwise: by a signal, out of time, another exception.
  double longest = 0;        ///< Seconds that an attempt took at most.
  double peakMegabytes = 0;  ///< Of memory, of a child or of what it started in turn.
};

namespace detail {

struct ForkedState {
  std::size_t current, successes, errors, reports;
  double longest;
  long peakKilobytes;
};

inline void limitChild() {
#ifndef PDC_SANITIZED  // Sanitizers reserve terabytes of addresses.
  constexpr rlim_t kAddressSpace = rlim_t{4} << 30;
  const rlimit limit{kAddressSpace, kAddressSpace};
  ::setrlimit(RLIMIT_AS, &limit);
#endif
  const rlimit noCore{0, 0};
  ::setrlimit(RLIMIT_CORE, &noCore);
}

/// Notes what an attempt took that began then.
inline void noteCosts(std::chrono::steady_clock::time_point begin, ForkedState& state) {
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  state.longest = std::max(state.longest, passed.count());
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    if (::getrusage(who, &usage) == 0) state.peakKilobytes = std::max(state.peakKilobytes, usage.ru_maxrss);
  }
}

#ifdef PDC_SANITIZED
inline ForkedState* reportingState = nullptr;
/// Counts what sanitizers report in children of the children too, where it looks like a library that gave up. Memory
/// that a limit refuses is no fault: sanitizers report it in the place of std::bad_alloc.
inline void countReports(ForkedState& state) {
  reportingState = &state;
  ::__sanitizer_set_death_callback([] {
    const std::string_view what = &::__asan_get_report_description == nullptr ? "" : ::__asan_get_report_description();
    if (what != "out-of-memory") ++reportingState->reports;
  });
}
#else
inline void countReports(ForkedState& /*state*/) {}
#endif

[[noreturn]] inline void runChild(std::size_t begin, std::size_t end, const std::function<void(std::size_t)>& attempt,
                                  ForkedState& state) {
  constexpr unsigned kSeconds = 10;
  limitChild();
  countReports(state);
  for (std::size_t i = begin; i < end; ++i) {
    state.current = i;
    ::alarm(kSeconds);
    const auto start = std::chrono::steady_clock::now();
    try {
      attempt(i);
      ++state.successes;
    } catch (const Error&) {
      ++state.errors;
    } catch (...) {
      ::_exit(1);
    }
    noteCosts(start, state);
  }
  ::_exit(0);
}

}  // namespace detail

/// Calls attempt(0), ..., attempt(count - 1) in children of `perChild` attempts each, with ten seconds and 4 GiB of
/// address space for each. The calling process must not have started threads.
inline ForkedResult runForked(std::size_t count, std::size_t perChild,
                              const std::function<void(std::size_t)>& attempt) {
  auto* state = static_cast<detail::ForkedState*>(
      ::mmap(nullptr, sizeof(detail::ForkedState), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  if (state == MAP_FAILED) return {0, 0, "no shared memory"};
  *state = {};
  ForkedResult result;
  for (std::size_t begin = 0; begin < count && result.failure.empty(); begin += perChild) {
    const pid_t child = ::fork();
    if (child == 0) detail::runChild(begin, std::min(count, begin + perChild), attempt, *state);
    int status = 0;
    ::waitpid(child, &status, 0);
    const std::string which = "attempt " + std::to_string(state->current);
    if (WIFSIGNALED(status)) result.failure = which + " ended by signal " + std::to_string(WTERMSIG(status));
    // Sanitizers end a process that way, too, after a report.
    if (WIFEXITED(status) && WEXITSTATUS(status) != 0) result.failure = which + " threw something that is no Error";
  }
  if (state->reports > 0 && result.failure.empty())
    result.failure = std::to_string(state->reports) + " reports of sanitizers";
  result.successes = state->successes;
  result.errors = state->errors;
  result.longest = state->longest;
  constexpr double kKilobytes = 1000;
  result.peakMegabytes = static_cast<double>(state->peakKilobytes) / kKilobytes;
  ::munmap(state, sizeof(detail::ForkedState));
  return result;
}

}  // namespace pdc
