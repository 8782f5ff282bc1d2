#pragma once

#include <cstdint>

namespace pdc::detail {

/// One number for an ordered pair of vertices.
[[nodiscard]] inline std::uint64_t vertexPairKey(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{a} << 32 | b;
}

/// Decides among pairs of vertices that cost the same: flat parts have nothing else.
[[nodiscard]] inline std::uint32_t vertexPairHash(std::uint32_t a, std::uint32_t b) {
  std::uint64_t h = vertexPairKey(a, b) * 0x9E3779B97F4A7C15u;  // Steele, Lea & Flood 2014, SplitMix.
  h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9u;
  return static_cast<std::uint32_t>(h >> 32);
}

}  // namespace pdc::detail
