#pragma once

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "math/lane_loops.h"
#include "pdc/monitor.h"
#include "pdc/sample/hermite_block.h"
#include "sample/block_index.h"
#include "sample/value_reader.h"

namespace pdc::detail {

/// Gives a leaf's 512 values by offset; booleans, which leaves store as bits, are copied for that.
template <typename LeafT>
class LeafValues {
 public:
  using ValueT = typename LeafT::ValueType;
  static constexpr bool kCopies = std::is_same_v<ValueT, bool>;

  /// Valid until the next call.
  [[nodiscard]] const ValueT* read(const LeafT& leaf) {
    if constexpr (kCopies) {
      for (openvdb::Index i = 0; i < LeafT::SIZE; ++i) mCopy[i] = leaf.getValue(i);
      return mCopy.data();
    } else {
      return leaf.buffer().data();
    }
  }

 private:
  std::array<ValueT, kCopies ? LeafT::SIZE : 0> mCopy;
};

/// Blocks beyond this index would overflow 32-bit lattice coordinates once a neighbour is added.
inline constexpr openvdb::Int32 kMaxIndex = 1 << 30;

/// \throws Error if a lattice point lies too far out.
inline void checkIndex(const openvdb::Coord& c) {
  for (int i = 0; i < 3; ++i)
    if (c[i] > kMaxIndex || c[i] < -kMaxIndex)
      throw Error(fmt::format("the grid reaches index {}, the limit is {}", c[i], kMaxIndex));
}

/// Where the points of a block lie.
enum class Side : std::uint8_t { kOutside, kInside, kBoth };

/// The leaves of a tree as blocks: which of their points are inside, which are active, found by block coordinate.
template <typename TreeT>
class GridLeaves {
 public:
  using LeafT = typename TreeT::LeafNodeType;
  using ValueT = typename TreeT::ValueType;
  static_assert(LeafT::DIM == kBlockSize, "blocks are leaves");

  /// Reads all leaves in parallel. \throws Error for non-finite values that were not accepted.
  GridLeaves(const TreeT& tree, const ValueReader<ValueT>& reader, bool acceptNonFinite) : mReader(reader) {
    tree.getNodes(mLeaves);
    mCoords.resize(mLeaves.size());
    mInside.resize(mLeaves.size());
    mSide.resize(mLeaves.size());
    for (const LeafT* leaf : mLeaves) checkIndex(leaf->origin());
    std::vector<std::size_t> nonFinite(mLeaves.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mLeaves.size(), 64), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const openvdb::Coord o = mLeaves[i]->origin();
        mCoords[i] = blockOf({o.x(), o.y(), o.z()});
        nonFinite[i] = readLeaf(*mLeaves[i], mInside[i]);
        mSide[i] = sideOf(mInside[i]);
      }
    });
    if (!acceptNonFinite) rejectNonFinite(nonFinite);
    mIndex = BlockIndex(mCoords);
  }

  [[nodiscard]] std::size_t size() const { return mLeaves.size(); }
  [[nodiscard]] const std::vector<Coord>& coords() const { return mCoords; }
  [[nodiscard]] std::int32_t find(const Coord& block) const { return mIndex.find(block); }
  [[nodiscard]] const CellMask& inside(std::size_t i) const { return mInside[i]; }
  [[nodiscard]] Side side(std::size_t i) const { return mSide[i]; }
  [[nodiscard]] const LeafT& leaf(std::size_t i) const { return *mLeaves[i]; }
  /// The leaf's active points, bits as in CellMask.
  [[nodiscard]] CellMask active(std::size_t i) const {
    CellMask m;
    const auto& mask = mLeaves[i]->getValueMask();
    for (openvdb::Index w = 0; w < 8; ++w) m.word[w] = mask.template getWord<std::uint64_t>(w);
    return m;
  }

 private:
  /// \returns the number of values that are not finite.
  std::size_t readLeaf(const LeafT& leaf, CellMask& inside) const {
    LeafValues<LeafT> reader;
    const ValueT* values = reader.read(leaf);
    bool allFinite = true;
    forEachBlock(mLevel, 8, [&](std::size_t x) { inside.word[x] = mReader.insideBits(values + 64 * x, allFinite); });
    std::size_t bad = 0;
    for (openvdb::Index i = 0; !allFinite && i < LeafT::SIZE; ++i) bad += !ValueReader<ValueT>::finite(values[i]);
    return bad;
  }

  static Side sideOf(const CellMask& inside) {
    std::uint64_t any = 0, all = ~std::uint64_t{0};
    for (const std::uint64_t w : inside.word) {
      any |= w;
      all &= w;
    }
    return any == 0 ? Side::kOutside : ~all == 0 ? Side::kInside : Side::kBoth;
  }

  void rejectNonFinite(const std::vector<std::size_t>& counts) const {
    std::size_t total = 0;
    const LeafT* first = nullptr;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      total += counts[i];
      if (counts[i] != 0 && first == nullptr) first = mLeaves[i];
    }
    if (first == nullptr) return;
    openvdb::Index offset = 0;
    while (ValueReader<ValueT>::finite(first->getValue(offset))) ++offset;
    const openvdb::Coord at = first->offsetToGlobalCoord(offset);
    throw Error(fmt::format(
        "{} voxels are not finite, the first at ({}, {}, {}) is {}; accept them as outside if that is meant", total,
        at.x(), at.y(), at.z(), static_cast<double>(first->getValue(offset))));
  }

  ValueReader<ValueT> mReader;
  SimdLevel mLevel = bestSimdLevel();
  std::vector<const LeafT*> mLeaves;
  std::vector<Coord> mCoords;
  std::vector<CellMask> mInside;
  std::vector<Side> mSide;
  BlockIndex mIndex;
};

}  // namespace pdc::detail
