#pragma once

#include <array>
#include <bit>
#include <span>
#include <vector>

#include "extract/block_topology.h"
#include "pdc/sample/feature_planes.h"
#include "pdc/sample/hermite_block.h"

namespace pdc::detail {

/// EdgeIndex slots of a cell's edges, from the slot of its low corner along x.
inline constexpr auto kEdgeSlot = [] {
  std::array<int, kEdges> slot{};
  for (int e = 0; e < kEdges; ++e) {
    const int low = edgeLowCorner(e);
    slot[e] = EdgeIndex::slot(edgeAxis(e), low & 1, low >> 1 & 1, low >> 2);
  }
  return slot;
}();

/// The low corner of a patch's cell, in its block.
constexpr Coord cellOf(const SurfacePatch& p) { return {p.cell >> 6, p.cell >> 3 & 7, p.cell & 7}; }

/// Where EdgeIndex::numbers() starts for the cell of a patch: that of kEdgeSlot.
constexpr int slotOf(const SurfacePatch& p) { return EdgeIndex::slot(0, p.cell >> 6, p.cell >> 3 & 7, p.cell & 7); }

/// The low end of an edge of a cell, from the cell's low corner.
constexpr Vec3d lowEnd(int e) {
  const int low = edgeLowCorner(e);
  return {double(low & 1), double(low >> 1 & 1), double(low >> 2)};
}

/// Calls visit(edge of the cell, its number in the block) for each of a patch's edges, in ascending order.
template <typename Visit>
void forEachEdge(const SurfacePatch& patch, const EdgeIndex& edges, Visit&& visit) {
  const std::uint16_t* number = edges.numbers() + slotOf(patch);
  for (unsigned bits = patch.edges; bits != 0; bits &= bits - 1) {
    const int e = std::countr_zero(bits);
    visit(e, int{number[kEdgeSlot[e]]});
  }
}

/// The patches of a block's cells, in the order of their vertices.
class PatchList {
 public:
  void fill(const BlockTopology& topology, const BlockSigns& signs);

  [[nodiscard]] std::size_t size() const { return mPatches.size(); }
  [[nodiscard]] const SurfacePatch& operator[](std::size_t i) const { return mPatches[i]; }
  [[nodiscard]] std::span<const SurfacePatch> patches() const { return mPatches; }
  /// Whether patch i is of a cell in which not every place is safe (see CellEntry), or of several.
  [[nodiscard]] bool strict(std::size_t i) const { return mStrict[i] != 0; }

 private:
  std::vector<SurfacePatch> mPatches;
  std::vector<std::uint8_t> mStrict;
};

}  // namespace pdc::detail
