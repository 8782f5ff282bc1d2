#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "extract/topology/block_topology.h"

namespace pdc::detail {

/// Blocks of which first the vertices are solved, then faces written: few enough that what faces need of vertices is in
/// a cache of the thread's own still, enough that the code of either is not fetched anew each time. With 2 instead of
/// 32 a sphere took half as long again.
inline constexpr std::size_t kGroupBlocks = 32;

/// A run of blocks in groups, which threads take one after the other.
class BlockGroups {
 public:
  BlockGroups(const Topology& topology, std::size_t begin, std::size_t end)
      : mTopology(topology), mBegin(begin), mEnd(end), mSolved((end - begin + kGroupBlocks - 1) / kGroupBlocks) {}

  struct Range {
    std::size_t group, begin, end;  ///< The blocks from begin to end - 1.
  };
  [[nodiscard]] std::size_t count() const { return mSolved.size(); }
  /// May be called as often as there are groups.
  [[nodiscard]] Range take() {
    const std::size_t group = mNext.fetch_add(1, std::memory_order_relaxed), begin = mBegin + group * kGroupBlocks;
    return {group, begin, std::min(begin + kGroupBlocks, mEnd)};
  }
  /// To be called when the vertices of the group's blocks are written: who asks for them then finds them so.
  void setSolved(std::size_t group) { mSolved[group].store(true, std::memory_order_release); }
  /// Whether, once a block's own vertices are solved, all others are that its faces have.
  [[nodiscard]] bool hasItsVertices(std::size_t block) const {
    return std::ranges::all_of(mTopology.blocks[block].lower, [this](std::int32_t lower) {
      return lower < static_cast<std::int32_t>(mBegin) ||
             mSolved[(static_cast<std::size_t>(lower) - mBegin) / kGroupBlocks].load(std::memory_order_acquire);
    });
  }

 private:
  const Topology& mTopology;
  const std::size_t mBegin, mEnd;
  std::vector<std::atomic<bool>> mSolved;
  std::atomic<std::size_t> mNext = 0;
};

}  // namespace pdc::detail
