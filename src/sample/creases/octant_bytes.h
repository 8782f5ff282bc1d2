#pragma once

#include <cstdint>

/// Words of eight bytes, a byte per voxel, a bit per octant.
namespace pdc::detail {

inline constexpr std::uint64_t kEachByte = 0x0101010101010101;

/// Byte k is full where bit k is set, and empty elsewhere. \pre bits < 256
constexpr std::uint64_t bytesOfBits(unsigned bits) {
  constexpr std::uint64_t kDiagonal = 0x8040201008040201;
  // Each byte keeps its own bit, which then carries into the byte's top bit.
  return (((bits * kEachByte & kDiagonal) + 0x7F * kEachByte) >> 7 & kEachByte) * 0xFF;
}

/// Byte k is the number of bits that are set in the bytes below it.
constexpr std::uint64_t bitsBelowEachByte(std::uint64_t bits) {
  bits -= bits >> 1 & 0x55 * kEachByte;
  bits = (bits & 0x33 * kEachByte) + (bits >> 2 & 0x33 * kEachByte);
  return ((bits + (bits >> 4)) & 0x0F * kEachByte) * kEachByte << 8;
}

}  // namespace pdc::detail
