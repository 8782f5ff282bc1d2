#include "pdc/math/simd_level.h"

namespace pdc {

SimdLevel bestSimdLevel() {
#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
  static const SimdLevel kBest = [] {
    __builtin_cpu_init();
    const bool bits =
        __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("popcnt");
    if (!bits) return SimdLevel::kBaseline;
    if (__builtin_cpu_supports("avx512f")) return SimdLevel::kAvx512;
    return __builtin_cpu_supports("avx2") ? SimdLevel::kAvx2 : SimdLevel::kBaseline;
  }();
  return kBest;
#else
  return SimdLevel::kBaseline;
#endif
}

}  // namespace pdc
