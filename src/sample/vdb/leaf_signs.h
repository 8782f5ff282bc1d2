#pragma once

#include <openvdb/openvdb.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <bit>
#include <type_traits>
#include <vector>

#include "math/lane_loops.h"
#include "pdc/sample/hermite_block.h"
#include "sample/stencils/block_parts.h"
#include "sample/stencils/isovalue_points.h"
#include "sample/vdb/leaf_table.h"
#include "sample/vdb/value_reader.h"

namespace pdc::detail {

/// Gives a leaf's 512 values by offset; booleans, which leaves store as bits, are copied for that.
template <typename LeafT>
class LeafValues {
 public:
  using ValueT = typename LeafT::ValueType;
  static constexpr bool kCopies = std::is_same_v<ValueT, bool>;

  /// \param values as the leaf stores them. \returns them, or the copy, valid until the next call.
  [[nodiscard]] const ValueT* read(const LeafT& leaf, const ValueT* values) {
    if constexpr (kCopies) {
      for (openvdb::Index i = 0; i < LeafT::SIZE; ++i) mCopy[i] = leaf.getValue(i);
      return mCopy.data();
    } else {
      return values;
    }
  }

 private:
  std::array<ValueT, kCopies ? LeafT::SIZE : 0> mCopy;
};

/// Which points of a tree's leaves are inside; see isovalue_points.h for those on the isovalue.
template <typename TreeT>
class LeafSigns {
 public:
  using LeafT = typename TreeT::LeafNodeType;
  using ValueT = typename TreeT::ValueType;
  using Table = LeafTable<TreeT>;

  /// Reads all leaves in parallel.
  LeafSigns(const Table& table, const ValueReader<ValueT>& reader)
      : mTable(table), mReader(reader), mInside(table.size()), mSide(table.size()) {
    std::atomic<bool> allFinite = true;
    tbb::enumerable_thread_specific<std::vector<std::size_t>> onIso;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, table.size(), 64), [&](const auto& range) {
      LeafValues<LeafT> values;
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        if (i + 1 < range.end()) prefetch(table.values(i + 1));
        const Remarks remarks = readLeaf(values.read(table.leaf(i), table.values(i)), mInside[i]);
        mSide[i] = sideOf(mInside[i]);
        if (!remarks.allFinite) allFinite.store(false, std::memory_order_relaxed);
        if (remarks.anyOnIso) onIso.local().push_back(i);
      }
    });
    mAllFinite = allFinite;
    for (const std::vector<std::size_t>& leaves : onIso) mOnIso.insert(mOnIso.end(), leaves.begin(), leaves.end());
    addPointsBetween();
  }

  /// Whether all values of the leaves are.
  [[nodiscard]] bool allFinite() const { return mAllFinite; }
  [[nodiscard]] const CellMask& inside(std::size_t leaf) const { return mInside[leaf]; }
  [[nodiscard]] Side side(std::size_t leaf) const { return mSide[leaf]; }
  [[nodiscard]] Side side(const typename Table::Place& place) const {
    if (place.leaf >= 0) return mSide[static_cast<std::size_t>(place.leaf)];
    return mReader.inside(place.tile) ? Side::kInside : Side::kOutside;
  }
  /// The points of whatever lies in a place, bits as in CellMask.
  [[nodiscard]] CellMask mask(const typename Table::Place& place) const {
    if (place.leaf >= 0) return mInside[static_cast<std::size_t>(place.leaf)];
    return mReader.inside(place.tile) ? CellMask::all() : CellMask{};
  }

 private:
  /// A leaf's values span few pages, which the processor does not follow by itself.
  static void prefetch(const ValueT* values) {
    if constexpr (!LeafValues<LeafT>::kCopies)
      for (std::size_t i = 0; i < LeafT::SIZE; i += 64 / sizeof(ValueT)) __builtin_prefetch(values + i);
  }

  using Remarks = typename ValueReader<ValueT>::Remarks;

  [[nodiscard]] Remarks readLeaf(const ValueT* values, CellMask& inside) const {
    Remarks remarks;
    forEachBatch(mLevel, kBlockSize,
                 [&](std::size_t x) { inside.word[x] = mReader.insideBits(values + 64 * x, remarks); });
    return remarks;
  }

  /// Adds the points on the isovalue that lie between two that are strictly inside. All are found before any is added.
  void addPointsBetween() {
    std::vector<CellMask> added(mOnIso.size());
    tbb::parallel_for(std::size_t{0}, mOnIso.size(), [&](std::size_t i) { added[i] = pointsBetween(mOnIso[i]); });
    for (std::size_t i = 0; i < mOnIso.size(); ++i) {
      CellMask& inside = mInside[mOnIso[i]];
      for (int x = 0; x < kBlockSize; ++x) inside.word[x] |= added[i].word[x];
      mSide[mOnIso[i]] = sideOf(inside);
    }
  }

  [[nodiscard]] CellMask pointsBetween(std::size_t leaf) const {
    const typename Table::Around around(mTable, mTable.coord(leaf));
    CellMask points =
        detail::pointsBetween(mInside[leaf], {mask(around(-1, 0, 0)), mask(around(1, 0, 0)), mask(around(0, -1, 0)),
                                              mask(around(0, 1, 0)), mask(around(0, 0, -1)), mask(around(0, 0, 1))});
    for (int x = 0; x < kBlockSize; ++x) {
      std::uint64_t& word = points.word[x];
      for (std::uint64_t bits = word & ~mInside[leaf].word[x]; bits != 0; bits &= bits - 1) {
        const int i = std::countr_zero(bits);
        if (!mReader.onIso(mTable.leaf(leaf).getValue(static_cast<openvdb::Index>(64 * x + i))))
          word &= ~(std::uint64_t{1} << i);
      }
    }
    return points;
  }

  const Table& mTable;
  const ValueReader<ValueT>& mReader;
  const SimdLevel mLevel = bestSimdLevel();
  Buffer<CellMask> mInside;
  Buffer<Side> mSide;
  bool mAllFinite = true;
  std::vector<std::size_t> mOnIso;  ///< Leaves with values on the isovalue, in any order.
};

}  // namespace pdc::detail
