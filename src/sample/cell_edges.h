#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "pdc/math/vec3.h"
#include "pdc/sample/feature_planes.h"
#include "pdc/sample/hermite_block.h"

/// How the corners and edges of a cell are numbered: corner c = x + 2y + 4z; edge e = 4·axis + k, whose lower corner
/// lies at bit 0 of k along the next axis and at bit 1 of k along the one after.
namespace pdc::detail {

inline constexpr int kCorners = 8, kEdges = 12;

/// An edge of a cell.
struct CellEdge {
  Axis axis;
  int low, high;  ///< Its ends among the cell's corners.
  int slot;       ///< In EdgeIndex, from that of the cell's lowest corner along x.
};

/// The edges of a cell by number.
inline constexpr auto kCellEdge = [] {
  std::array<CellEdge, kEdges> edges{};
  for (int e = 0; e < kEdges; ++e) {
    const Axis axis = kAxes[e / 4];
    std::array<int, 3> low{};
    low[nextAxis(axis)] = e & 1;
    low[previousAxis(axis)] = e >> 1 & 1;
    const int corner = low[0] + 2 * low[1] + 4 * low[2];
    edges[e] = {axis, corner, corner | 1 << axis, EdgeIndex::slot(axis, low[0], low[1], low[2])};
  }
  return edges;
}();

/// A corner of a cell, from its lowest one.
constexpr Coord cornerStep(int corner) { return {corner & 1, corner >> 1 & 1, corner >> 2}; }
constexpr Vec3d cornerPlace(int corner) { return {double(corner & 1), double(corner >> 1 & 1), double(corner >> 2)}; }

/// The corners of a cell of a block that are inside, a bit each.
constexpr int cellCode(const BlockSigns& signs, int x, int y, int z) {
  const auto pair = [&](int dx, int dy) { return signs.row[kBlockPoints * (x + dx) + y + dy] >> z & 3; };
  const int r00 = pair(0, 0), r10 = pair(1, 0), r01 = pair(0, 1), r11 = pair(1, 1);
  return (r00 & 1) | (r10 & 1) << 1 | (r01 & 1) << 2 | (r11 & 1) << 3 | (r00 >> 1) << 4 | (r10 >> 1) << 5 |
         (r01 >> 1) << 6 | (r11 >> 1) << 7;
}

/// Where EdgeIndex::numbers() starts for a cell: what CellEdge::slot counts from.
constexpr int slotOf(BlockCell cell) { return EdgeIndex::slot(kAxisX, cell.x(), cell.y(), cell.z()); }

/// Calls visit(edge of the cell, its number in the block) for each of a patch's edges, in ascending order.
template <typename Visit>
void forEachEdge(const SurfacePatch& patch, const EdgeIndex& edges, Visit&& visit) {
  const std::uint16_t* number = edges.numbers() + slotOf(patch.cell);
  for (unsigned bits = patch.edges; bits != 0; bits &= bits - 1) {
    const int e = std::countr_zero(bits);
    visit(e, int{number[kCellEdge[e].slot]});
  }
}

}  // namespace pdc::detail
