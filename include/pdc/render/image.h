#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pdc {

/// A picture: sRGB, eight bits a channel, rows from the top, without padding.
struct Image {
  int width = 0, height = 0;  ///< In pixels.
  std::vector<std::array<std::uint8_t, 3>> pixels;

  /// The pixel in column x and row y, from 0; not checked.
  [[nodiscard]] const std::array<std::uint8_t, 3>& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

}  // namespace pdc
