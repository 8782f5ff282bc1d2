#pragma once

#include <array>

#include "extract/block_topology.h"
#include "extract/loose_vertex.h"

namespace pdc::detail {

/// The four cells about a lattice edge along `axis`, counter-clockwise seen from its high end: steps back along the
/// next axis and the one after.
inline constexpr int kRing[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/// The number, within a cell, of the lattice edge whose k-th ring cell it is.
constexpr int ringEdge(int axis, int k) { return 4 * axis + kRing[k][0] + 2 * kRing[k][1]; }

/// A cell of a block.
struct CellRef {
  std::int32_t block;
  int x, y, z;
};

/// A set of edges, as bits of their blocks.
class EdgeSet {
 public:
  EdgeSet() = default;
  EdgeSet(std::size_t blocks, const std::vector<EdgeRef>& edges) : mSlot(blocks, -1) {
    for (const EdgeRef& e : edges) {
      std::int32_t& slot = mSlot[e.block];
      if (slot < 0) {
        slot = static_cast<std::int32_t>(mEdges.size());
        mEdges.emplace_back();
      }
      mEdges[slot][e.axis()].set(e.x(), e.y(), e.z());
    }
  }
  [[nodiscard]] bool hasBlock(std::int32_t block) const { return mSlot[block] >= 0; }
  /// By axis. \pre hasBlock(block)
  [[nodiscard]] const std::array<CellMask, 3>& edges(std::int32_t block) const { return mEdges[mSlot[block]]; }

 private:
  std::vector<std::int32_t> mSlot;
  std::vector<std::array<CellMask, 3>> mEdges;
};

/// Finds one's way between cells, lattice edges and their quads in a finished topology.
class QuadRings {
 public:
  QuadRings(const SurfaceBlocks& blocks, const Topology& topology) : mBlocks(blocks), mTopology(topology) {}

  /// Number of the edge's quad.
  [[nodiscard]] std::uint64_t face(const EdgeRef& e) const;
  /// Cells about the edge, in ring order.
  [[nodiscard]] std::array<CellRef, 4> cells(const EdgeRef& e) const;
  /// Vertices of the edge's quad, in ring order.
  [[nodiscard]] Quad vertices(const EdgeRef& e) const;
  /// Lattice coordinates of the edge's low end.
  [[nodiscard]] Coord low(const EdgeRef& e) const;
  /// Whether the low end is inside.
  [[nodiscard]] bool lowInside(const EdgeRef& e) const;

  /// Calls visit(EdgeRef, edge of the cell) for each of the cell's edges that has a quad.
  template <typename Visit>
  void forEachEdge(const CellRef& c, Visit&& visit) const;
  /// Calls visit(EdgeRef) for each edge with a quad whose low end lies in the box, borders included, if it is one of
  /// `among`.
  template <typename Visit>
  void forEachIn(const Coord& from, const Coord& to, const EdgeSet* among, Visit&& visit) const;

  [[nodiscard]] int code(const CellRef& c) const { return cellCode(mBlocks.signs[c.block], c.x, c.y, c.z); }
  [[nodiscard]] const BlockTopology& block(std::int32_t i) const { return mTopology.blocks[i]; }
  [[nodiscard]] std::size_t blockCount() const { return mBlocks.coords.size(); }
  [[nodiscard]] const Coord& blockCoord(std::int32_t i) const { return mBlocks.coords[i]; }

 private:
  const SurfaceBlocks& mBlocks;
  const Topology& mTopology;
};

template <typename Visit>
void QuadRings::forEachEdge(const CellRef& c, Visit&& visit) const {
  for (unsigned bits = kCellTable[code(c)].edges; bits != 0; bits &= bits - 1) {
    const int e = std::countr_zero(bits), corner = edgeLowCorner(e), axis = edgeAxis(e);
    const int x = c.x + (corner & 1), y = c.y + (corner >> 1 & 1), z = c.z + (corner >> 2);
    std::int32_t owner = c.block;
    if (((x | y | z) & 8) != 0) {
      const Coord& b = mBlocks.coords[c.block];
      owner = mTopology.index.find({b[0] + (x >> 3), b[1] + (y >> 3), b[2] + (z >> 3)});
      if (owner == BlockIndex::kMissing) continue;
    }
    if (!mTopology.blocks[owner].edges[axis].test(x & 7, y & 7, z & 7)) continue;
    visit(EdgeRef{owner, static_cast<std::uint16_t>(512 * axis + 64 * (x & 7) + 8 * (y & 7) + (z & 7))}, e);
  }
}

template <typename Visit>
void QuadRings::forEachIn(const Coord& from, const Coord& to, const EdgeSet* among, Visit&& visit) const {
  const Coord first = blockOf(from), last = blockOf(to);
  for (Coord b = first; b[0] <= last[0]; ++b[0])
    for (b[1] = first[1]; b[1] <= last[1]; ++b[1])
      for (b[2] = first[2]; b[2] <= last[2]; ++b[2]) {
        const std::int32_t block = mTopology.index.find(b);
        if (block == BlockIndex::kMissing || (among != nullptr && !among->hasBlock(block))) continue;
        std::array<int, 3> begin, end;
        for (int i = 0; i < 3; ++i) {
          begin[i] = std::max(from[i] - kBlockSize * b[i], 0);
          end[i] = std::min(to[i] - kBlockSize * b[i], kBlockSize - 1);
        }
        std::uint64_t wanted = 0;
        for (int y = begin[1]; y <= end[1]; ++y)
          wanted |= ((std::uint64_t{2} << end[2]) - (std::uint64_t{1} << begin[2])) << 8 * y;
        const auto& edges = among != nullptr ? among->edges(block) : mTopology.blocks[block].edges;
        for (int axis = 0; axis < 3; ++axis)
          for (int x = begin[0]; x <= end[0]; ++x)
            for (std::uint64_t w = edges[axis].word[x] & wanted; w != 0; w &= w - 1)
              visit(EdgeRef{block, static_cast<std::uint16_t>(512 * axis + 64 * x + std::countr_zero(w))});
      }
}

}  // namespace pdc::detail
