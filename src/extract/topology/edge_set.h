#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "extract/topology/block_refs.h"
#include "pdc/sample/hermite_block.h"

namespace pdc::detail {

/// A set of sign-changing lattice edges, as bits of the blocks that have some.
class EdgeSet {
 public:
  /// \param edges sorted.
  EdgeSet(std::size_t blockCount, const std::vector<EdgeRef>& edges) : mPlace(blockCount, -1) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const EdgeRef& e = edges[i];
      std::int32_t& place = mPlace[e.block];
      if (place < 0) {
        place = static_cast<std::int32_t>(mBlocks.size());
        mBlocks.emplace_back();
      }
      Block& block = mBlocks[place];
      CellMask& mask = block.edges[e.axis()];
      if (mask.word[e.x()] == 0) block.before[kBlockSize * e.axis() + e.x()] = i;
      mask.set(e.x(), e.y(), e.z());
    }
  }

  /// Blocks that have some, numbered from 0 in the order in which they came.
  [[nodiscard]] std::size_t size() const { return mBlocks.size(); }
  /// The block's number among those, or -1.
  [[nodiscard]] std::int32_t place(std::int32_t block) const { return mPlace[block]; }
  /// The edges of the block with that number, along one axis.
  [[nodiscard]] const CellMask& edges(std::int32_t place, Axis axis) const { return mBlocks[place].edges[axis]; }
  [[nodiscard]] bool has(const EdgeRef& e) const {
    const std::int32_t place = mPlace[e.block];
    return place >= 0 && mBlocks[place].edges[e.axis()].test(e.x(), e.y(), e.z());
  }
  /// The position in the list of an edge that is there.
  [[nodiscard]] std::size_t number(const EdgeRef& e) const {
    const Block& block = mBlocks[mPlace[e.block]];
    const std::uint64_t below = (std::uint64_t{1} << (8 * e.y() + e.z())) - 1;
    return block.before[kBlockSize * e.axis() + e.x()] + bitCount(block.edges[e.axis()].word[e.x()] & below);
  }

 private:
  struct Block {
    std::array<CellMask, 3> edges;
    std::array<std::size_t, 3 * kBlockSize> before;  ///< Edges in the list before those of a word that has some.
  };

  std::vector<std::int32_t> mPlace;  ///< The number of each block among those that have some, or -1.
  std::vector<Block> mBlocks;
};

}  // namespace pdc::detail
