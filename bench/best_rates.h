#pragma once

#include <algorithm>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

/// Rates of operations on a machine that others use too: every candidate runs for a moment in turn, round after round,
/// and the best of its rounds counts. Time is that in which the thread ran.
namespace pdc::bench {

struct Candidate {
  std::function<void()> run;  ///< Does `count` operations.
  std::size_t count = 0;
  std::size_t repeats = 1;  ///< Calls that fill a moment.
  double rate = 0;          ///< Operations per second, the best so far.
};

inline double threadSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Runs a candidate for a moment and keeps the rate if it is the best.
inline void runMoment(Candidate& c) {
  constexpr double kMoment = 2e-3;
  const double start = threadSeconds();
  for (std::size_t i = 0; i < c.repeats; ++i) c.run();
  const double seconds = std::max(threadSeconds() - start, 1e-9);
  const double calls = static_cast<double>(c.repeats);
  c.rate = std::max(c.rate, calls * static_cast<double>(c.count) / seconds);
  c.repeats = static_cast<std::size_t>(std::clamp(calls * kMoment / seconds, 1.0, 1e6));
}

inline void runRounds(std::vector<Candidate*> candidates, int rounds) {
  for (int round = 0; round < rounds; ++round)
    for (Candidate* c : candidates) runMoment(*c);
}

}  // namespace pdc::bench
