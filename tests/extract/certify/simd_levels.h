#pragma once

#include <cstdio>
#include <vector>

#include "pdc/math/simd_level.h"

namespace pdc {

/// The instruction sets that this processor has, for tests that compare them. Prints which these are, and which are
/// missing, because levels above the best one run as that one: comparing those would compare nothing.
inline std::vector<SimdLevel> availableSimdLevels() {
  struct Named {
    SimdLevel level;
    const char* name;
  };
  std::vector<SimdLevel> available;
  for (const Named& n : {Named{SimdLevel::kBaseline, "baseline"}, Named{SimdLevel::kAvx2, "AVX2"},
                         Named{SimdLevel::kAvx512, "AVX-512"}}) {
    const bool has = n.level <= bestSimdLevel();
    std::printf("[   SIMD   ] %s: %s\n", n.name, has ? "compared" : "not compared, this processor does not have it");
    if (has) available.push_back(n.level);
  }
  return available;
}

}  // namespace pdc
