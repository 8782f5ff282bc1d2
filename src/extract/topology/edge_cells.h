#pragma once

#include <array>

#include "extract/topology/block_topology.h"
#include "extract/topology/suspect_vertex.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// The four cells about a lattice edge along `axis`, counter-clockwise seen from its high end: steps back along the
/// next axis and the one after.
inline constexpr int kCellsAboutEdge[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/// The number, within a cell, of the lattice edge whose k-th ring cell it is.
constexpr int edgeInCell(Axis axis, int k) { return 4 * axis + kCellsAboutEdge[k][0] + 2 * kCellsAboutEdge[k][1]; }

constexpr CellRef cellOf(const SuspectVertex& v) { return {v.block, v.cell.x(), v.cell.y(), v.cell.z()}; }

/// Cells, lattice edges and their quads, each found from the others, in a finished topology.
class EdgeCells {
 public:
  EdgeCells(const SurfaceBlocks& blocks, const Topology& topology) : mBlocks(blocks), mTopology(topology) {}

  /// Number of the edge's quad.
  [[nodiscard]] std::uint64_t face(const EdgeRef& e) const {
    const BlockTopology& b = mTopology.blocks[e.block];
    const std::uint64_t before = (std::uint64_t{1} << (8 * e.y() + e.z())) - 1;
    return b.firstQuad + b.quadsBefore[kBlockSize * e.axis() + e.x()] +
           bitCount(b.edges[e.axis()].word[e.x()] & before);
  }
  /// Cells about the edge, in order about the edge.
  [[nodiscard]] std::array<CellRef, 4> cells(const EdgeRef& e) const;
  /// Vertices of the edge's quad, in order about the edge.
  [[nodiscard]] Quad vertices(const EdgeRef& e) const;
  /// Lattice coordinates of the edge's low end.
  [[nodiscard]] Coord low(const EdgeRef& e) const;
  [[nodiscard]] Vec3d lowEnd(const EdgeRef& e) const {
    const Coord at = low(e);
    return {double(at[0]), double(at[1]), double(at[2])};
  }
  /// Whether the low end is inside.
  [[nodiscard]] bool lowInside(const EdgeRef& e) const;

  /// Calls visit(EdgeRef, edge of the cell) for each of the cell's edges that has a quad.
  template <typename Visit>
  void forEachEdge(const CellRef& c, Visit&& visit) const;
  /// Calls visit(EdgeRef) for each edge whose quad has the vertex.
  template <typename Visit>
  void forEachEdgeAt(const SuspectVertex& v, Visit&& visit) const;
  /// The block of a block coordinate, or BlockIndex::kMissing.
  [[nodiscard]] std::int32_t find(const Coord& block) const { return mTopology.index.find(block); }

  [[nodiscard]] int code(const CellRef& c) const { return cellCode(mBlocks.signs[c.block], c.x, c.y, c.z); }
  [[nodiscard]] const BlockTopology& block(std::int32_t i) const { return mTopology.blocks[i]; }
  [[nodiscard]] std::uint64_t faceCount() const { return mTopology.quadCount; }
  [[nodiscard]] std::size_t blockCount() const { return mBlocks.coords.size(); }
  [[nodiscard]] const Coord& blockCoord(std::int32_t i) const { return mBlocks.coords[i]; }

 private:
  const SurfaceBlocks& mBlocks;
  const Topology& mTopology;
};

template <typename Visit>
void EdgeCells::forEachEdge(const CellRef& c, Visit&& visit) const {
  for (unsigned bits = kCellTable[code(c)].edges; bits != 0; bits &= bits - 1) {
    const int e = std::countr_zero(bits);
    const Axis axis = kCellEdge[e].axis;
    const Coord step = cornerStep(kCellEdge[e].low);
    const int x = c.x + step[0], y = c.y + step[1], z = c.z + step[2];
    std::int32_t owner = c.block;
    if (((x | y | z) & 8) != 0) {
      const Coord& b = mBlocks.coords[c.block];
      owner = mTopology.index.find({b[0] + (x >> 3), b[1] + (y >> 3), b[2] + (z >> 3)});
      if (owner == BlockIndex::kMissing) continue;
    }
    const BlockCell low = BlockCell::at(x & 7, y & 7, z & 7);
    if (mTopology.blocks[owner].edges[axis].test(low.x(), low.y(), low.z())) visit(EdgeRef::at(owner, axis, low), e);
  }
}

template <typename Visit>
void EdgeCells::forEachEdgeAt(const SuspectVertex& v, Visit&& visit) const {
  const CellRef c = cellOf(v);
  const bool onlyOne = block(v.block).findMultiVertex(v.cell) == nullptr;
  forEachEdge(c, [&](const EdgeRef& e, int edge) {
    if (onlyOne || block(v.block).vertexAt(c.x, c.y, c.z, edge) == v.vertex) visit(e);
  });
}

}  // namespace pdc::detail
