#pragma once

#include <span>
#include <vector>

#include "extract/topology/block_topology.h"
#include "pdc/sample/feature_planes.h"

namespace pdc::detail {

/// The patches of a block's cells, in the order of their vertices.
class PatchList {
 public:
  void fill(const BlockTopology& topology, const BlockSigns& signs);

  [[nodiscard]] std::size_t size() const { return mPatches.size(); }
  [[nodiscard]] const SurfacePatch& operator[](std::size_t i) const { return mPatches[i]; }
  [[nodiscard]] std::span<const SurfacePatch> patches() const { return mPatches; }
  /// Whether not every place is safe in the cell of patch i (see CellEntry), or the cell has several patches.
  [[nodiscard]] bool ambiguous(std::size_t i) const { return mAmbiguous[i] != 0; }
  [[nodiscard]] bool anyAmbiguous() const { return mAnyAmbiguous; }
  /// Ascending, the patches of multi-vertex cells (see BlockTopology). Any other has all of its cell's crossings.
  [[nodiscard]] std::span<const std::uint32_t> multiVertex() const { return mMultiVertex; }

 private:
  std::vector<SurfacePatch> mPatches;
  std::vector<std::uint8_t> mAmbiguous;
  std::vector<std::uint32_t> mMultiVertex;
  bool mAnyAmbiguous = false;
};

}  // namespace pdc::detail
