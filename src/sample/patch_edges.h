#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "pdc/sample/feature_planes.h"
#include "pdc/sample/hermite_block.h"

namespace pdc::detail {

/// An edge of a cell.
struct CellEdge {
  int axis, low, high;  ///< Its ends among the cell's corners, x + 2y + 4z.
  int slot;             ///< In EdgeIndex, from that of the cell's lowest corner along x.
};

/// By number in SurfacePatch.
inline constexpr auto kCellEdge = [] {
  std::array<CellEdge, 12> edges{};
  for (int e = 0; e < 12; ++e) {
    const int axis = e >> 2;
    std::array<int, 3> low{};
    low[(axis + 1) % 3] = e & 1;
    low[(axis + 2) % 3] = e >> 1 & 1;
    const int corner = low[0] + 2 * low[1] + 4 * low[2];
    edges[e] = {axis, corner, corner | 1 << axis, EdgeIndex::slot(axis, low[0], low[1], low[2])};
  }
  return edges;
}();

/// A corner of a cell, from its lowest one.
constexpr Vec3d cornerPlace(int corner) { return {double(corner & 1), double(corner >> 1 & 1), double(corner >> 2)}; }

/// The corners of a cell of a block that are inside, a bit each.
constexpr int cellCode(const BlockSigns& signs, int x, int y, int z) {
  const auto pair = [&](int dx, int dy) { return signs.row[kBlockPoints * (x + dx) + y + dy] >> z & 3; };
  const int r00 = pair(0, 0), r10 = pair(1, 0), r01 = pair(0, 1), r11 = pair(1, 1);
  return (r00 & 1) | (r10 & 1) << 1 | (r01 & 1) << 2 | (r11 & 1) << 3 | (r00 >> 1) << 4 | (r10 >> 1) << 5 |
         (r01 >> 1) << 6 | (r11 >> 1) << 7;
}

/// The lowest corner of a patch's cell, in its block.
constexpr Coord cellOf(const SurfacePatch& p) { return {p.cell >> 6, p.cell >> 3 & 7, p.cell & 7}; }

/// Where EdgeIndex::numbers() starts for the cell of a patch: that of CellEdge::slot.
constexpr int slotOf(const SurfacePatch& p) { return EdgeIndex::slot(0, p.cell >> 6, p.cell >> 3 & 7, p.cell & 7); }

/// Calls visit(edge of the cell, its number in the block) for each of a patch's edges, in ascending order.
template <typename Visit>
void forEachEdge(const SurfacePatch& patch, const EdgeIndex& edges, Visit&& visit) {
  const std::uint16_t* number = edges.numbers() + slotOf(patch);
  for (unsigned bits = patch.edges; bits != 0; bits &= bits - 1) {
    const int e = std::countr_zero(bits);
    visit(e, int{number[kCellEdge[e].slot]});
  }
}

}  // namespace pdc::detail
