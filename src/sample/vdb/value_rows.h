#pragma once

#include <array>

#include "sample/vdb/leaf_signs.h"
#include "sample/vdb/leaf_table.h"

namespace pdc::detail {

/// The values of one place of a tree, a leaf or a tile, as 64 rows of eight along z.
template <typename TreeT>
class ValueRows {
 public:
  using Table = LeafTable<TreeT>;
  using ValueT = typename TreeT::ValueType;

  /// Must be called before row(). The table must live as long as rows are read.
  void find(const Table& table, const typename Table::Place& place) {
    mStride = place.leaf < 0 ? 0 : kBlockSize;
    if (place.leaf < 0) {
      mTile.fill(place.tile);
      mValues = mTile.data();
    } else {
      mValues = mLeaf.read(table.leaf(place.leaf), table.values(place.leaf));
    }
  }
  /// \param i as rowOf().
  [[nodiscard]] const ValueT* row(int i) const { return mValues + mStride * i; }
  /// The row of lattice points (x, y), from any block's origin.
  static constexpr int rowOf(int x, int y) { return kBlockSize * (x & 7) + (y & 7); }

 private:
  const ValueT* mValues = nullptr;
  int mStride = 0;  ///< A tile has the same row everywhere.
  std::array<ValueT, kBlockSize> mTile;
  LeafValues<typename TreeT::LeafNodeType> mLeaf;
};

}  // namespace pdc::detail
