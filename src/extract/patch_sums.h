#pragma once

#include <array>
#include <bit>
#include <span>
#include <vector>

#include "extract/block_topology.h"
#include "extract/crossing_rows.h"
#include "pdc/sample/feature_planes.h"
#include "pdc/sample/hermite_block.h"

namespace pdc::detail {

/// The sign-changing edges of a patch, by ascending number; places beyond `count` repeat the first.
struct PatchEdges {
  std::uint8_t count = 0;
  std::array<std::uint8_t, kEdges> edge{};

  constexpr PatchEdges() = default;
  constexpr explicit PatchEdges(unsigned edges) {
    for (int e = 0; e < kEdges; ++e)
      if ((edges >> e & 1) != 0) edge[count++] = static_cast<std::uint8_t>(e);
    for (int k = count; k < kEdges; ++k) edge[k] = edge[0];
  }
};

/// EdgeIndex slots of a cell's edges, from the slot of its low corner along x.
inline constexpr auto kEdgeSlot = [] {
  std::array<int, kEdges> slot{};
  for (int e = 0; e < kEdges; ++e) {
    const int low = edgeLowCorner(e);
    slot[e] = EdgeIndex::slot(edgeAxis(e), low & 1, low >> 1 & 1, low >> 2);
  }
  return slot;
}();

/// A vertex to be: the cell in its block (64x + 8y + z), the edges of its patch.
struct Patch {
  std::uint16_t cell;
  bool strict;  ///< See CellEntry.
  PatchEdges edges;

  [[nodiscard]] int x() const { return cell >> 6; }
  [[nodiscard]] int y() const { return cell >> 3 & 7; }
  [[nodiscard]] int z() const { return cell & 7; }
  /// Where EdgeIndex::numbers() starts for the cell.
  [[nodiscard]] int slot() const { return EdgeIndex::slot(0, x(), y(), z()); }
};

/// The patches of a block's cells in the order of their vertices, and what their crossings sum up to.
///
/// Sums lie one patch after the other, as CrossingRows lays them out: sum(i) holds the entries of Σrrᵀ, the sum of the
/// places from the block's origin and their number; rhs(i) is Σr(r·p) with p from the centre of the cell, which keeps
/// its rounding at that of numbers below one. Whoever has more planes for a cell adds them here.
class PatchSums {
 public:
  void list(const BlockTopology& topology, const BlockSigns& signs);
  /// \param level changes no bit of it.
  void sum(const CrossingRows& crossings, const EdgeIndex& edges, SimdLevel level);

  [[nodiscard]] std::size_t size() const { return mPatches.size(); }
  [[nodiscard]] const Patch& patch(std::size_t i) const { return mPatches[i]; }
  /// The same patches as a source takes them.
  [[nodiscard]] std::span<const SurfacePatch> forSource() const { return mForSource; }
  [[nodiscard]] const float* sum(std::size_t i) const { return mSums[i].at; }
  [[nodiscard]] const float* rhs(std::size_t i) const { return mRhs[i].data(); }

 private:
  struct alignas(64) Row {
    float at[kLanes];
  };

  std::vector<Patch> mPatches;
  std::vector<SurfacePatch> mForSource;
  std::vector<Row> mSums;
  std::vector<std::array<float, 4>> mRhs;
};

}  // namespace pdc::detail
