// Random chains of steps on odd and damaged grids: how many were taken, how many refused and for what. Usage:
// grid_chains [FIRST] [COUNT]. Exits with 1 if anything else than an error of one line came out of one.
#include "eval/grid_chains.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

int main(int argc, char** argv) {
  const unsigned first = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 0;
  const unsigned count = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 2000;
  std::map<std::string, int> refusals;
  int taken = 0, faults = 0;
  double longest = 0;
  for (unsigned seed = first; seed < first + count; ++seed) {
    const auto start = std::chrono::steady_clock::now();
    const pdc::eval::ChainOutcome outcome = pdc::eval::runRandomChain(seed);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    longest = std::max(longest, passed.count());
    if (passed.count() > 10) fmt::print("chain {} took {:.1f} s: {}\n", seed, passed.count(), outcome.what);
    if (!outcome.fault.empty()) {
      ++faults;
      fmt::print("chain {}: {}: {}\n", seed, outcome.fault, outcome.what);
    }
    // Numbers apart, the same refusals are one.
    std::string kind;
    for (const char c : outcome.refusal)
      if ((c < '0' || c > '9') && c != '.' && c != '+') kind += c;
    if (kind.empty()) {
      ++taken;
    } else {
      ++refusals[kind];
    }
    std::fflush(stdout);
  }
  for (const auto& [kind, times] : refusals) fmt::print("{:>5} refused: {}\n", times, kind);
  fmt::print("{} chains: {} taken, {} faults, {:.1f} s the longest\n", count, taken, faults, longest);
  return faults == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
