#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/forked.h"
#include "fuzz/mutate.h"
#include "io/file/temporary_folder.h"

namespace pdc {

/// Files by their names, whole.
using WholeFiles = std::vector<std::pair<std::string, std::string>>;

/// Damages each file in many ways, 10,000 of all together where PDC_LONG_TESTS is set, and reads it: that has to return
/// or to throw Error, within ten seconds and a memory that does not depend on what damaged headers say. Prints a line
/// for each file. \param usual how often each is damaged otherwise.
inline void expectReadOrRefused(const WholeFiles& files, std::size_t usual,
                                const std::function<void(const std::filesystem::path&)>& read) {
  constexpr std::size_t kLong = 10000, kPerChild = 100;
  const std::size_t attempts = std::getenv("PDC_LONG_TESTS") != nullptr ? kLong / files.size() + 1 : usual;
#ifdef PDC_SANITIZED
  constexpr double kMostMegabytes = 1500;  // What is freed stays there for a while.
#else
  constexpr double kMostMegabytes = 150;
#endif
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : files) writeContents(folder / name, bytes);
  std::size_t successes = 0, errors = 0;
  std::uint32_t seed = 0;
  for (const auto& [name, bytes] : files) {
    const ForkedResult whole = runForked(1, 1, [&](std::size_t) { read(folder / name); });
    EXPECT_EQ(whole.successes, 1u) << name << ": " << whole.failure;
    const std::filesystem::path path = folder / ("damaged_" + name);
    const ForkedResult result = runForked(attempts, kPerChild, [&](std::size_t i) {
      std::filesystem::remove(path);  // File systems flush a file that is overwritten.
      writeContents(path, mutate(bytes, seed + static_cast<std::uint32_t>(i)));
      read(path);
    });
    seed += static_cast<std::uint32_t>(attempts);
    std::printf("%-12s %5zu damaged: %5zu read, %5zu refused, %.2f s at most, peak %.0f MB\n", name.c_str(), attempts,
                result.successes, result.errors, result.longest, result.peakMegabytes);
    EXPECT_EQ(result.failure, "") << name;
    EXPECT_EQ(result.successes + result.errors, attempts) << name;
    EXPECT_LT(result.peakMegabytes, kMostMegabytes) << name;
    successes += result.successes;
    errors += result.errors;
  }
  EXPECT_GT(successes, attempts * files.size() / 20);
  EXPECT_GT(errors, attempts * files.size() / 4);
}

}  // namespace pdc
