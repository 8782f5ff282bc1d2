#pragma once

#include <array>
#include <cstddef>

#include "math/float4.h"
#include "pdc/math/quadric_lanes.h"

namespace pdc::detail {

/// Eight floats in a vector register.
using Float8 = float __attribute__((vector_size(32)));

/// Transposes four rows of four floats: row k of `to` becomes column k of `from`. Rows of `to` start `toStep` floats
/// apart.
inline void transpose4(const std::array<const float*, 4>& from, float* to, std::size_t toStep) {
  const Float4 a = loadFloat4(from[0]), b = loadFloat4(from[1]), c = loadFloat4(from[2]), d = loadFloat4(from[3]);
  const Float4 ab01 = __builtin_shufflevector(a, b, 0, 4, 1, 5), ab23 = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Float4 cd01 = __builtin_shufflevector(c, d, 0, 4, 1, 5), cd23 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  store(__builtin_shufflevector(ab01, cd01, 0, 1, 4, 5), to);
  store(__builtin_shufflevector(ab01, cd01, 2, 3, 6, 7), to + toStep);
  store(__builtin_shufflevector(ab23, cd23, 0, 1, 4, 5), to + 2 * toStep);
  store(__builtin_shufflevector(ab23, cd23, 2, 3, 6, 7), to + 3 * toStep);
}
inline void transpose4(const float* from, std::size_t fromStep, float* to, std::size_t toStep) {
  transpose4({from, from + fromStep, from + 2 * fromStep, from + 3 * fromStep}, to, toStep);
}

}  // namespace pdc::detail
