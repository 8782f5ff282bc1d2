#pragma once

#include <compare>
#include <cstdint>

#include "pdc/sample/lattice.h"

namespace pdc::detail {

/// A cell of a block, which is named by its position in the list of blocks.
struct CellRef {
  std::int32_t block;
  int x, y, z;

  [[nodiscard]] constexpr BlockCell cell() const { return BlockCell::at(x, y, z); }
};

/// A sign-changing lattice edge of a block, by its lower end; it stands for its quad.
struct EdgeRef {
  std::int32_t block;
  std::uint16_t edge;  ///< 512 axis + the number of the cell of the same name.

  static constexpr EdgeRef at(std::int32_t block, Axis axis, BlockCell low) {
    return {block, static_cast<std::uint16_t>(kBlockCells * axis + low.number)};
  }

  [[nodiscard]] constexpr Axis axis() const { return static_cast<Axis>(edge / kBlockCells); }
  [[nodiscard]] constexpr BlockCell low() const { return {static_cast<std::uint16_t>(edge % kBlockCells)}; }
  [[nodiscard]] constexpr int x() const { return low().x(); }
  [[nodiscard]] constexpr int y() const { return low().y(); }
  [[nodiscard]] constexpr int z() const { return low().z(); }
  friend constexpr auto operator<=>(const EdgeRef&, const EdgeRef&) = default;
};

}  // namespace pdc::detail
