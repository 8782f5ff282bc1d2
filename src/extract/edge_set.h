#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "extract/loose_vertex.h"
#include "pdc/sample/hermite_block.h"

namespace pdc::detail {

/// A set of sign-changing lattice edges, as bits of the blocks that have some.
class EdgeSet {
 public:
  EdgeSet(std::size_t blockCount, const std::vector<EdgeRef>& edges) : mPlace(blockCount, -1) {
    for (const EdgeRef& e : edges) {
      std::int32_t& place = mPlace[e.block];
      if (place < 0) {
        place = static_cast<std::int32_t>(mEdges.size());
        mEdges.emplace_back();
      }
      mEdges[place][e.axis()].set(e.x(), e.y(), e.z());
    }
  }

  /// Blocks that have some, numbered from 0 in the order in which they came.
  [[nodiscard]] std::size_t size() const { return mEdges.size(); }
  /// The block's number among those, or -1.
  [[nodiscard]] std::int32_t place(std::int32_t block) const { return mPlace[block]; }
  /// The edges of the block with that number, along one axis.
  [[nodiscard]] const CellMask& edges(std::int32_t place, int axis) const { return mEdges[place][axis]; }
  [[nodiscard]] bool has(const EdgeRef& e) const {
    const std::int32_t place = mPlace[e.block];
    return place >= 0 && mEdges[place][e.axis()].test(e.x(), e.y(), e.z());
  }

 private:
  std::vector<std::int32_t> mPlace;  ///< By block.
  std::vector<std::array<CellMask, 3>> mEdges;
};

}  // namespace pdc::detail
