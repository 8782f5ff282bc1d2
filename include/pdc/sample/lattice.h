#pragma once

#include <array>
#include <cstdint>

/// Space is a lattice of integer points. A *cell* is named by its lowest corner; a *block* is 8×8×8 cells and is named
/// by its block coordinate, the first cell's coordinate divided by 8.
namespace pdc {

/// An axis of the lattice; usable as an index.
enum Axis : int { kAxisX, kAxisY, kAxisZ };
inline constexpr std::array kAxes{kAxisX, kAxisY, kAxisZ};

/// The cyclic successor and predecessor of an axis: with it they are right-handed, (axis, next, previous).
constexpr Axis nextAxis(Axis axis) { return static_cast<Axis>((axis + 1) % 3); }
constexpr Axis previousAxis(Axis axis) { return static_cast<Axis>((axis + 2) % 3); }

inline constexpr int kBlockSize = 8;                 ///< Cells per block and axis.
inline constexpr int kBlockPoints = kBlockSize + 1;  ///< Lattice points per block and axis.
/// Cells of a block.
inline constexpr int kBlockCells = kBlockSize * kBlockSize * kBlockSize;

/// A lattice point, a cell, or a block coordinate.
using Coord = std::array<std::int32_t, 3>;

/// A cell of a block.
struct BlockCell {
  std::uint16_t number;  ///< 64x + 8y + z.

  static constexpr BlockCell at(int x, int y, int z) { return {static_cast<std::uint16_t>(64 * x + 8 * y + z)}; }

  [[nodiscard]] constexpr int x() const { return number >> 6; }
  [[nodiscard]] constexpr int y() const { return number >> 3 & 7; }
  [[nodiscard]] constexpr int z() const { return number & 7; }
  /// Its lowest corner, in the block.
  [[nodiscard]] constexpr Coord low() const { return {x(), y(), z()}; }
  friend constexpr auto operator<=>(const BlockCell&, const BlockCell&) = default;
};

}  // namespace pdc
