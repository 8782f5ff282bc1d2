#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "extract/topology/cell_table.h"
#include "pdc/monitor.h"
#include "pdc/sample/hermite_source.h"
#include "sample/block_index.h"
#include "sample/cell_edges.h"

namespace pdc::detail {

/// A cell that does not simply have one vertex for all its sign-changing edges.
struct MultiVertexCell {
  BlockCell cell;
  std::uint8_t vertexCount;   ///< At least 1.
  std::uint16_t extraBefore;  ///< Vertices beyond one per cell in the block's multi-vertex cells before this one.
  EdgeVertices vertex;        ///< Which of the vertices each edge with a quad belongs to.
  EdgeVertices patch;  ///< Which surface patch each sign-changing edge belongs to; vertices of one patch coincide.
};

/// Which vertices and quads a block owns: vertices of its cells, quads of the lattice edges that start at one of its
/// points. Without initial values: there are many, and each is set whole.
struct BlockTopology {
  CellMask cells;                                         ///< Cells with at least one vertex.
  std::array<CellMask, 3> edges;                          ///< Per axis, the edges that get a quad.
  std::array<std::uint16_t, kBlockSize> cellsBefore;      ///< Cells in the words of `cells` before word x.
  std::array<std::uint16_t, 3 * kBlockSize> quadsBefore;  ///< By axis and x: quads in the words of `edges` before.
  std::array<std::int32_t, 8> lower;             ///< Positions of the blocks at -dx, -dy, -dz; index 4dx + 2dy + dz.
  std::span<const MultiVertexCell> multiVertex;  ///< By ascending cell; part of Topology::multiVertex.
  std::uint32_t vertexCount, quadCount;
  std::uint32_t openArcs;  ///< Vertices whose faces form an open fan; each is one end of two boundary edges.
  std::uint64_t firstVertex, firstQuad;

  /// The multi-vertex cell entry of a cell, or null.
  [[nodiscard]] const MultiVertexCell* findMultiVertex(BlockCell cell) const;
  /// Number in the mesh of the vertex that an edge's quad uses in a cell of this block.
  [[nodiscard]] std::uint64_t vertexAt(int x, int y, int z, int edge) const {
    const std::uint64_t below = (std::uint64_t{1} << (8 * y + z)) - 1;
    const std::uint64_t n = firstVertex + cellsBefore[x] + bitCount(cells.word[x] & below);
    return multiVertex.empty() ? n : n + multiVertexOffset(BlockCell::at(x, y, z), edge);
  }

 private:
  /// What multi-vertex cells add to the number of cells before: vertices beyond the first of earlier ones, and of this
  /// one.
  [[nodiscard]] std::uint64_t multiVertexOffset(BlockCell cell, int edge) const;
};

/// The topology of all blocks, with vertices and quads numbered through in block order.
struct Topology {
  Buffer<BlockTopology> blocks;
  std::vector<std::vector<MultiVertexCell>> multiVertex;  ///< Those of all blocks, in chunks.
  BlockIndex index;
  std::uint64_t vertexCount = 0, quadCount = 0, openArcs = 0, multiVertexCells = 0;

  Topology() = default;
  Topology(Topology&&) = default;
  Topology& operator=(Topology&&) = default;
};

/// Whether cells on both sides of an ambiguous face may be flipped. kNever exists for the tests, which show what it
/// breaks.
enum class FlipRule { kSymmetric, kNever };

/// Runs in parallel over blocks.
[[nodiscard]] Topology buildTopology(const SurfaceBlocks& blocks, const Monitor& monitor,
                                     FlipRule rule = FlipRule::kSymmetric);

/// \throws Error if 32-bit indices cannot name that many vertices.
void checkVertexCount(std::uint64_t vertices);

}  // namespace pdc::detail
