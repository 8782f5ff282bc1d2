#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "pdc/math/vec3.h"
#include "pdc/sample/lattice.h"

/// The seam between inputs and extraction: whoever can fill BlockSigns and HermiteBlock (an OpenVDB leaf, an implicit
/// function) gets the whole extractor.
namespace pdc {

namespace detail {
/// Number of set bits, without the instruction that plain x86-64 lacks.
constexpr std::uint64_t bitCount(std::uint64_t v) {
  v -= v >> 1 & 0x5555555555555555;
  v = (v & 0x3333333333333333) + (v >> 2 & 0x3333333333333333);
  return ((v + (v >> 4)) & 0x0F0F0F0F0F0F0F0F) * 0x0101010101010101 >> 56;
}
}  // namespace detail

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
    std::uint64_t n = 0;
    for (const auto w : word) n += detail::bitCount(w);
    return static_cast<int>(n);
  }
};

/// Which of a block's 9×9×9 lattice points are inside, and which of its cells take part.
struct BlockSigns {
  /// Row 9x + y holds the points (x, y, 0..8) in bits 0..8. A set bit is inside: value < iso. Of points
  /// on the isovalue the source decides.
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
  [[nodiscard]] int size() const { return mStart[3]; }
  /// The edges along `axis` are numbers begin(axis) to begin(axis + 1) - 1.
  [[nodiscard]] int begin(int axis) const { return mStart[axis]; }
  /// Lower end points of all edges, as 256x + 16y + z.
  [[nodiscard]] const std::uint16_t* points() const { return mPoint.data(); }
  /// Number of the edge along `axis` from (x, y, z); meaningful only if it changes sign.
  [[nodiscard]] int operator()(Axis axis, int x, int y, int z) const { return mNumber[slot(axis, x, y, z)]; }
  /// Calls visit(number, axis, x, y, z) for each sign-changing edge in order.
  template <typename Visit>
  void forEach(Visit&& visit) const {
    for (const Axis axis : kAxes)
      for (int i = mStart[axis]; i < mStart[axis + 1]; ++i)
        visit(i, axis, mPoint[i] >> 8, mPoint[i] >> 4 & 15, mPoint[i] & 15);
  }

  /// Where numbers() holds the number of an edge.
  [[nodiscard]] static constexpr int slot(Axis axis, int x, int y, int z) {
    return ((axis * kBlockPoints + x) * kBlockPoints + y) * kBlockPoints + z;
  }
  /// The numbers by slot; meaningful only for edges that change sign.
  [[nodiscard]] const std::uint16_t* numbers() const { return mNumber.data(); }

 private:
  /// How far beyond its end a list may be written.
  static constexpr int kRoom = 64;

  void fill(const BlockSigns& signs);

  // Not cleared: a block uses little of them.
  std::array<std::uint16_t, kMaxEdges + kRoom> mPoint;
  std::array<std::uint16_t, 3 * kBlockPoints * kBlockPoints * kBlockPoints + kRoom> mNumber;
  std::array<int, 4> mStart{};
};

/// Hermite data of one block: for each sign-changing edge, in EdgeIndex order, where the surface crosses and with which
/// normal. Structure of arrays, reused from block to block; a source may write anything beyond the last edge.
struct HermiteBlock {
  /// Room for whole vector registers.
  static constexpr int kCapacity = EdgeIndex::kMaxEdges + 16;

  /// Position of the crossing along its edge, from the lower end, in [0, 1].
  std::array<float, kCapacity> t;
  /// Outward unit normal in world space; zero where none could be found (the crossing then counts as a point only).
  std::array<float, kCapacity> nx, ny, nz;
};

}  // namespace pdc
