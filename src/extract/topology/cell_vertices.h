#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "extract/topology/block_topology.h"
#include "math/word_bits.h"

namespace pdc::detail {

/// Numbers in the mesh of the vertices of a block's cells and of the cells one below it. Should be compiled into a
/// function of a SimdLevel.
class CellVertices {
 public:
  CellVertices(const Topology& topology, const BlockTopology& own) {
    // Edges have cells about them that lie below on two axes at most.
    std::array<const BlockTopology*, 7> blocks{&own};
    for (int i = 1; i < 7; ++i)
      if (own.lower[i] != BlockIndex::kMissing) blocks[i] = &topology.blocks[own.lower[i]];
    for (const BlockTopology* b : blocks) mAllSimple = mAllSimple && (b == nullptr || b->multiVertex.empty());
    if (!mAllSimple) mMultiVertexAt.assign(mVertex.size(), nullptr);
    for (int i = 0; i < 7; ++i)
      if (blocks[i] != nullptr) add(*blocks[i], i >> 2, i >> 1 & 1, i & 1);
  }

  /// Whether each cell has one vertex at most.
  [[nodiscard]] bool allSimple() const { return mAllSimple; }
  /// Step from a cell to the next along an axis.
  static constexpr std::array<int, 3> kStep{kBlockPoints * kBlockPoints, kBlockPoints, 1};
  /// Points to the number of a cell of the block; those of its neighbours lie kStep away.
  [[nodiscard]] const std::uint32_t* at(BlockCell cell) const {
    const int n = cell.number;
    return &mVertex[index(0, 0, 0) + n + (n >> 3) + kBlockPoints * (n >> 6)];
  }
  /// The number of the vertex that an edge's quad uses in the cell whose number `at` points to, unless allSimple().
  [[nodiscard]] std::uint32_t vertexAt(const std::uint32_t* at, int edge) const {
    const MultiVertexCell* cell = mMultiVertexAt[at - mVertex.data()];
    return *at + (cell == nullptr ? 0 : static_cast<std::uint32_t>(cell->vertex[edge]));
  }

 private:
  static constexpr int index(int x, int y, int z) { return kStep[0] * (x + 1) + kStep[1] * (y + 1) + z + 1; }

  /// Adds the cells of a block at -(dx, dy, dz), or of these those in its last layer on each of these axes.
  void add(const BlockTopology& b, int dx, int dy, int dz) {
    if ((dx | dy | dz) == 0 && b.multiVertex.empty()) return addOwn(b);
    const std::uint64_t wanted =
        (dy != 0 ? std::uint64_t{0xFF} << 56 : ~std::uint64_t{0}) & (dz != 0 ? 0x8080808080808080 : ~std::uint64_t{0});
    const MultiVertexCell* multi = b.multiVertex.data();
    const MultiVertexCell* const end = multi + b.multiVertex.size();
    std::uint32_t extra = 0;  // Vertices beyond one per cell in the cells before.
    for (int x = dx != 0 ? kBlockSize - 1 : 0; x < kBlockSize; ++x) {
      const std::uint64_t word = b.cells.word[x];
      // The cell may lie outside the block; its neighbours that are asked for do not.
      const int first = index(x - kBlockSize * dx, -kBlockSize * dy, -kBlockSize * dz);
      const auto number = static_cast<std::uint32_t>(b.firstVertex + b.cellsBefore[x]);
      for (std::uint64_t w = word & wanted; w != 0; w &= w - 1) {
        const int bit = std::countr_zero(w);
        const std::uint64_t before = word & ((std::uint64_t{1} << bit) - 1);
        const int place = first + bit + (bit >> 3);
        for (; multi != end && multi->cell.number < 64 * x + bit; ++multi)
          extra = multi->extraBefore + multi->vertexCount - 1U;
        if (multi != end && multi->cell.number == 64 * x + bit) mMultiVertexAt[place] = multi;
        mVertex[place] = number + extra + static_cast<std::uint32_t>(std::popcount(before));
      }
    }
  }

  void addOwn(const BlockTopology& b) {
    for (int x = 0; x < kBlockSize; ++x) {
      const std::uint64_t word = b.cells.word[x];
      if (word == 0) continue;
      const int first = index(x, 0, 0);
      const auto number = static_cast<std::uint32_t>(b.firstVertex + b.cellsBefore[x]);
      writeBits<8>(word,
                   [&](int i, int bit) { mVertex[first + bit + (bit >> 3)] = number + static_cast<std::uint32_t>(i); });
    }
  }

  bool mAllSimple = true;
  std::vector<const MultiVertexCell*> mMultiVertexAt;  ///< Beside each number, unless mAllSimple; null for other cells.
  // Not cleared: only cells that have a vertex are asked for. With room for what is written beyond the last.
  std::array<std::uint32_t, kBlockPoints * kBlockPoints * kBlockPoints + kBlockPoints> mVertex;
};

}  // namespace pdc::detail
