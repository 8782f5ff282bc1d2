#include "extract/topology/edge_cells.h"

namespace pdc::detail {

std::array<CellRef, 4> EdgeCells::cells(const EdgeRef& e) const {
  const BlockTopology& own = mTopology.blocks[e.block];
  const Axis u = nextAxis(e.axis()), v = previousAxis(e.axis());
  std::array<CellRef, 4> ring;
  for (int k = 0; k < 4; ++k) {
    Coord c{e.x(), e.y(), e.z()};
    c[u] -= kCellsAboutEdge[k][0];
    c[v] -= kCellsAboutEdge[k][1];
    const int lower = (c[0] < 0) << 2 | (c[1] < 0) << 1 | (c[2] < 0);
    ring[k] = {lower == 0 ? e.block : own.lower[lower], c[0] & 7, c[1] & 7, c[2] & 7};
  }
  return ring;
}

Quad EdgeCells::vertices(const EdgeRef& e) const {
  const std::array<CellRef, 4> ring = cells(e);
  Quad q;
  for (int k = 0; k < 4; ++k) {
    const CellRef& c = ring[k];
    q[k] = static_cast<std::uint32_t>(mTopology.blocks[c.block].vertexAt(c.x, c.y, c.z, edgeInCell(e.axis(), k)));
  }
  return q;
}

Coord EdgeCells::low(const EdgeRef& e) const {
  const Coord& b = mBlocks.coords[e.block];
  return {kBlockSize * b[0] + e.x(), kBlockSize * b[1] + e.y(), kBlockSize * b[2] + e.z()};
}

bool EdgeCells::lowInside(const EdgeRef& e) const { return mBlocks.signs[e.block].inside(e.x(), e.y(), e.z()); }

}  // namespace pdc::detail
