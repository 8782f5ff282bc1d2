#pragma once

#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <vector>

#include "pdc/math/simd_level.h"

namespace pdc::test {

[[nodiscard]] inline const char* nameOf(SimdLevel level) {
  switch (level) {
    case SimdLevel::kBaseline:
      return "baseline";
    case SimdLevel::kAvx2:
      return "AVX2";
    case SimdLevel::kAvx512:
      return "AVX-512";
  }
  return "unknown";
}

/// The levels above the baseline that this processor runs; only these can be compared with it. What is compared and
/// what this processor lacks is printed and recorded as a property of the test, once for each test.
[[nodiscard]] inline std::vector<SimdLevel> wideSimdLevels() {
  std::vector<SimdLevel> levels;
  std::string compared, lacking;
  for (const SimdLevel level : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    const bool here = level <= bestSimdLevel();
    if (here) levels.push_back(level);
    (here ? compared : lacking) += std::string(" ") + nameOf(level);
  }
  static const testing::TestInfo* last = nullptr;
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  if (test != last) {
    last = test;
    testing::Test::RecordProperty("simd_levels_compared", compared);
    testing::Test::RecordProperty("simd_levels_lacking", lacking);
    std::cout << "compared with the baseline:" << (compared.empty() ? " nothing" : compared)
              << "; this processor lacks:" << (lacking.empty() ? " nothing" : lacking) << '\n';
  }
  return levels;
}

/// The baseline, followed by wideSimdLevels().
[[nodiscard]] inline std::vector<SimdLevel> simdLevels() {
  std::vector<SimdLevel> levels = wideSimdLevels();
  levels.insert(levels.begin(), SimdLevel::kBaseline);
  return levels;
}

}  // namespace pdc::test
