#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "pdc/math/quadric_lanes.h"
#include "pdc/math/simd_level.h"

/// Loops over batches and their lanes, compiled once for every SimdLevel. Bodies are written for one lane, in plain
/// scalars; `flatten` pulls them into the function that has the instruction set, where the compiler vectorises them.
namespace pdc::detail {

/// Calls f(lane) for the first `count` lanes, in no promised order. Lanes do not see each other: f may read and write
/// any batch at its own lane only.
template <int count = kLanes, typename F>
inline void forEachLane(const F& f) {
#if defined(__clang__)
#pragma clang loop vectorize(assume_safety)
#else
#pragma GCC ivdep
#endif
  for (int lane = 0; lane < count; ++lane) f(lane);
}

/// Folds kLanes values into one, lanes 8 apart first, so that the order is the same on every processor. It is written
/// in vectors, because g++ would vectorise plain loops across several folds in a row, by way of permutations. \param
/// fold makes fold(a, b) of two vectors in the first.
template <typename T, typename F>
inline T foldLanes(const T* lanes, const F& fold) {
  static_assert(kLanes == 16 && sizeof(T) == 4);
  using Eight [[gnu::vector_size(32)]] = T;
  using Four [[gnu::vector_size(16)]] = T;
  Eight low, high;
  std::memcpy(&low, lanes, sizeof low);
  std::memcpy(&high, lanes + 8, sizeof high);
  fold(low, high);
  Four four = __builtin_shufflevector(low, low, 0, 1, 2, 3);
  fold(four, __builtin_shufflevector(low, low, 4, 5, 6, 7));
  fold(four, __builtin_shufflevector(four, four, 2, 3, 0, 1));
  fold(four, __builtin_shufflevector(four, four, 1, 0, 3, 2));
  return four[0];
}
inline float sumLanes(const float* lanes) {
  return foldLanes(lanes, [](auto& a, const auto& b) { a += b; });
}
/// None of the values may be NaN.
inline float maxLanes(const float* lanes) {
  return foldLanes(lanes, [](auto& a, const auto& b) { a = a > b ? a : b; });
}
inline std::int32_t minLanes(const std::int32_t* lanes) {
  return foldLanes(lanes, [](auto& a, const auto& b) { a = a < b ? a : b; });
}

template <typename F>
[[gnu::flatten]] void loopBaseline(std::size_t count, const F& f) {
  for (std::size_t i = 0; i < count; ++i) f(i);
}

#if defined(__x86_64__)
template <typename F>
[[gnu::flatten, gnu::target("avx2,bmi,bmi2,popcnt")]] void loopAvx2(std::size_t count, const F& f) {
  for (std::size_t i = 0; i < count; ++i) f(i);
}

template <typename F>
[[gnu::flatten, gnu::target("avx512f,bmi,bmi2,popcnt")]] void loopAvx512(std::size_t count, const F& f) {
  for (std::size_t i = 0; i < count; ++i) f(i);
}
#endif

/// Calls f(i) for i = 0 … count − 1 with the instructions of `level`, or of the processor's best level if that is
/// lower.
template <typename F>
void forEachBatch(SimdLevel level, std::size_t count, const F& f) {
#if defined(__x86_64__)
  switch (std::min(level, bestSimdLevel())) {
    case SimdLevel::kAvx512:
      return loopAvx512(count, f);
    case SimdLevel::kAvx2:
      return loopAvx2(count, f);
    case SimdLevel::kBaseline:
      break;
  }
#else
  static_cast<void>(level);
#endif
  loopBaseline(count, f);
}

/// Calls f() once, with the instructions that forEachBatch() would take.
template <typename F>
void withSimd(SimdLevel level, const F& f) {
  forEachBatch(level, 1, [&f](std::size_t) { f(); });
}

}  // namespace pdc::detail
