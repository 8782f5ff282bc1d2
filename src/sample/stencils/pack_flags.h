#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace pdc::detail {

/// Bit i is flag[i], which is 0 or 1.
inline std::uint64_t packFlags(const std::uint8_t (&flag)[64]) {
  static_assert(std::endian::native == std::endian::little);
  std::uint64_t bits = 0;
  for (int k = 0; k < 8; ++k) {
    std::uint64_t eight;
    std::memcpy(&eight, flag + 8 * k, sizeof eight);
    // Bit i of the product's top byte is byte i of the factor; no two of its terms fall on one bit.
    bits |= (eight * 0x0102040810204080 >> 56) << 8 * k;
  }
  return bits;
}

}  // namespace pdc::detail
