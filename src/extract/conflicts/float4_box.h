#pragma once

#include <array>
#include <cstddef>

#include "math/float4.h"

namespace pdc::detail {

/// An axis-aligned box in vector registers.
struct Float4Box {
  Float4 low, high;

  Float4Box() = default;
  template <std::size_t n>
  explicit Float4Box(const std::array<Vec3f, n>& points) : low(float4(points[0])), high(low) {
    for (std::size_t i = 1; i < n; ++i) add(float4(points[i]));
  }
  void add(Float4 p) {
    low = p < low ? p : low;
    high = p > high ? p : high;
  }
  void add(const Float4Box& b) {
    add(b.low);
    add(b.high);
  }
  /// Takes in what rounding may have put beyond it.
  void addRounding() {
    constexpr float kTwoUlps = 2.5e-7F;
    low -= (low < 0.0F ? -low : low) * kTwoUlps;
    high += (high < 0.0F ? -high : high) * kTwoUlps;
  }
  [[nodiscard]] bool contains(const Float4Box& b) const { return !anyOf((b.low < low) | (b.high > high)); }
  [[nodiscard]] bool apartFrom(const Float4Box& b) const { return anyOf((low > b.high) | (b.low > high)); }

 private:
  template <typename Mask>
  static bool anyOf(Mask mask) {
    using Halves = long long __attribute__((vector_size(16)));
    const auto halves = reinterpret_cast<Halves>(mask);
    return (halves[0] | halves[1]) != 0;
  }
};

}  // namespace pdc::detail
