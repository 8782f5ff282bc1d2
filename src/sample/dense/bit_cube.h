#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "pdc/sample/lattice.h"

/// 8×8×8 bits as eight words of eight bytes, and how their axes change places.
namespace pdc::detail {

using BitCube = std::array<std::uint64_t, 8>;

/// Byte k of word i becomes byte i of word k.
inline void swapWordsAndBytes(BitCube& w) {
  const auto exchange = [](std::uint64_t& a, std::uint64_t& b, int shift, std::uint64_t mask) {
    const std::uint64_t t = (a >> shift ^ b) & mask;
    b ^= t;
    a ^= t << shift;
  };
  for (int i = 0; i < 4; ++i) exchange(w[i], w[i + 4], 32, 0x00000000FFFFFFFF);
  for (const int i : {0, 1, 4, 5}) exchange(w[i], w[i + 2], 16, 0x0000FFFF0000FFFF);
  for (const int i : {0, 2, 4, 6}) exchange(w[i], w[i + 1], 8, 0x00FF00FF00FF00FF);
}

/// Bit k of byte i becomes bit i of byte k, in every word.
inline void swapBytesAndBits(BitCube& w) {
  for (std::uint64_t& word : w) {
    const auto exchange = [&word](int shift, std::uint64_t mask) {
      const std::uint64_t t = (word ^ word >> shift) & mask;
      word ^= t ^ t << shift;
    };
    exchange(7, 0x00AA00AA00AA00AA);
    exchange(14, 0x0000CCCC0000CCCC);
    exchange(28, 0x00000000F0F0F0F0);
  }
}

/// Turns a cube so that words run along x, bytes along y and bits along z. \param axes what each of the three ran
/// along.
inline void turnToXyz(std::array<Axis, 3> axes, BitCube& cube) {
  while (axes != std::array{kAxisX, kAxisY, kAxisZ}) {
    if (axes[0] > axes[1]) {
      swapWordsAndBytes(cube);
      std::swap(axes[0], axes[1]);
    } else {
      swapBytesAndBits(cube);
      std::swap(axes[1], axes[2]);
    }
  }
}

}  // namespace pdc::detail
