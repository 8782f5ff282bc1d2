#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "pdc/math/vec3.h"

/// The seam between inputs and extraction. Space is a lattice of integer points; a *cell* is named by its lowest
/// corner; a *block* is 8×8×8 cells and is named by its block coordinate, the first cell's coordinate divided by 8.
/// Whoever can fill BlockSigns and HermiteBlock (an OpenVDB leaf, an implicit function) gets the whole extractor.
namespace pdc {

inline constexpr int kBlockSize = 8;                 ///< Cells per block and axis.
inline constexpr int kBlockPoints = kBlockSize + 1;  ///< Lattice points per block and axis.

/// A lattice point, a cell, or a block coordinate.
using Coord = std::array<std::int32_t, 3>;

/// Number of set bits of each 9-bit row: without a processor's own instruction a table is the quickest way to count.
inline constexpr auto kBitCount = [] {
  std::array<std::uint8_t, 512> count{};
  for (unsigned bits = 1; bits < count.size(); ++bits)
    count[bits] = static_cast<std::uint8_t>(count[bits >> 1] + (bits & 1));
  return count;
}();

/// 512 bits, one per cell (or per lattice edge owned by the cell of the same name); z runs fastest: word x, bit 8y + z.
struct CellMask {
  std::array<std::uint64_t, kBlockSize> word{};

  static constexpr CellMask all() {
    CellMask m;
    m.word.fill(~std::uint64_t{0});
    return m;
  }
  [[nodiscard]] constexpr bool test(int x, int y, int z) const { return (word[x] >> (8 * y + z) & 1) != 0; }
  constexpr void set(int x, int y, int z) { word[x] |= std::uint64_t{1} << (8 * y + z); }
  constexpr void reset(int x, int y, int z) { word[x] &= ~(std::uint64_t{1} << (8 * y + z)); }
  [[nodiscard]] constexpr bool none() const {
    std::uint64_t any = 0;
    for (const auto w : word) any |= w;
    return any == 0;
  }
  [[nodiscard]] constexpr int count() const {
    int n = 0;
    for (const auto w : word) n += std::popcount(w);
    return n;
  }
};

/// Which of a block's 9×9×9 lattice points are inside, and which of its cells take part.
struct BlockSigns {
  /// Row 9x + y holds the points (x, y, 0..8) in bits 0..8. A set bit is inside: value < iso, strictly.
  std::array<std::uint16_t, kBlockPoints * kBlockPoints> row{};
  /// Cells that take part in the surface: all of them in closed mode, those with eight active corners in open mode.
  CellMask cells = CellMask::all();

  [[nodiscard]] constexpr bool inside(int x, int y, int z) const { return (row[kBlockPoints * x + y] >> z & 1) != 0; }
  /// True if all 729 points are on one side, that is if the block holds no surface.
  [[nodiscard]] constexpr bool uniform() const {
    std::uint16_t any = 0, all = 0x1FF;
    for (const auto r : row) {
      any |= r;
      all &= r;
    }
    return any == 0 || all == 0x1FF;
  }
};

/// The lattice edges of a block that change sign, in a fixed order: axis x, y, z; then by the lower end point, z
/// fastest. Derived from the signs alone, so that a source and the extractor number crossings alike.
class EdgeIndex {
 public:
  /// At most 3 · 8 · 9 · 9 edges.
  static constexpr int kMaxEdges = 3 * kBlockSize * kBlockPoints * kBlockPoints;

  explicit EdgeIndex(const BlockSigns& signs);

  /// Number of sign-changing edges.
  [[nodiscard]] int size() const { return mSize; }
  /// Sign-changing edges along `axis` whose lower end is in row (x, y); bit z.
  [[nodiscard]] std::uint16_t row(int axis, int x, int y) const { return mRow[axis][kBlockPoints * x + y]; }
  /// Number of the edge along `axis` from (x, y, z); meaningful only if it changes sign.
  [[nodiscard]] int operator()(int axis, int x, int y, int z) const {
    const int r = kBlockPoints * x + y;
    return mStart[axis][r] + kBitCount[mRow[axis][r] & ((1u << z) - 1u)];
  }
  /// Calls visit(number, axis, x, y, z) for each sign-changing edge in order.
  template <typename Visit>
  void forEach(Visit&& visit) const {
    int n = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (int x = 0; x < kBlockPoints; ++x)
        for (int y = 0; y < kBlockPoints; ++y)
          for (unsigned bits = row(axis, x, y); bits != 0; bits &= bits - 1)
            visit(n++, axis, x, y, std::countr_zero(bits));
  }

 private:
  std::array<std::array<std::uint16_t, kBlockPoints * kBlockPoints>, 3> mRow{};
  std::array<std::array<std::uint16_t, kBlockPoints * kBlockPoints>, 3> mStart{};
  int mSize = 0;
};

/// Hermite data of one block: for each sign-changing edge, in EdgeIndex order, where the surface crosses and with which
/// normal. Structure of arrays, reused from block to block.
struct HermiteBlock {
  /// Position of the crossing along its edge, from the lower end, in [0, 1].
  std::array<float, EdgeIndex::kMaxEdges> t;
  /// Outward unit normal in world space; zero where none could be found (the crossing then counts as a point only).
  std::array<float, EdgeIndex::kMaxEdges> nx, ny, nz;
};

}  // namespace pdc
