#pragma once

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <tbb/parallel_for.h>

#include <array>
#include <numeric>
#include <type_traits>
#include <vector>

#include "pdc/error.h"
#include "pdc/mesh/mesh.h"
#include "sample/block_index.h"

namespace pdc::detail {

/// Blocks beyond this index would overflow 32-bit lattice coordinates once a neighbour is added.
inline constexpr openvdb::Int32 kMaxIndex = 1 << 30;

/// \throws Error if a lattice point lies too far out.
inline void checkIndex(const openvdb::Coord& c) {
  for (int i = 0; i < 3; ++i)
    if (c[i] > kMaxIndex || c[i] < -kMaxIndex)
      throw Error(fmt::format("the grid reaches index {}, the limit is {}", c[i], kMaxIndex));
}

/// The leaves of a tree, numbered, and found from block coordinates through the internal nodes above them: each of
/// these knows the numbers of its leaves and its 26 neighbours, so that one look-up serves a block and all blocks
/// around it.
template <typename TreeT>
class LeafTable {
 public:
  using LeafT = typename TreeT::LeafNodeType;
  using ValueT = typename TreeT::ValueType;
  using Parent = typename TreeT::RootNodeType::ChildNodeType::ChildNodeType;
  static_assert(LeafT::DIM == kBlockSize, "blocks are leaves");
  static constexpr int kLog2Places = Parent::LOG2DIM;
  static constexpr int kPlaces = 1 << kLog2Places;  ///< Leaf-sized places of a parent along an axis.
  static constexpr std::int32_t kNoLeaf = -1;

  /// Runs in parallel. \throws Error if a leaf lies too far out.
  explicit LeafTable(const TreeT& tree) : mTree(tree) {
    tree.getNodes(mParents);
    std::vector<Coord> origins(mParents.size());
    std::vector<std::int32_t> first(mParents.size() + 1);
    for (std::size_t p = 0; p < mParents.size(); ++p) {
      const openvdb::Coord o = mParents[p]->origin();
      checkIndex(o);
      origins[p] = {o.x() >> kLog2Points, o.y() >> kLog2Points, o.z() >> kLog2Points};
      first[p + 1] = static_cast<std::int32_t>(mParents[p]->getChildMask().countOn());
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    mParentIndex = BlockIndex(origins);
    mPlaces.resize(mParents.size());
    mAround.resize(mParents.size());
    mLeaves.resize(static_cast<std::size_t>(first.back()));
    tbb::parallel_for(std::size_t{0}, mParents.size(), [&](std::size_t p) {
      findNeighbours(origins[p], mAround[p]);
      numberLeaves(p, first[p]);
    });
    readHeaders();
  }

  [[nodiscard]] std::size_t size() const { return mLeaves.size(); }
  [[nodiscard]] const Coord& coord(std::size_t leaf) const { return mLeaves[leaf].coord; }
  [[nodiscard]] const LeafT& leaf(std::size_t leaf) const { return *mLeaves[leaf].node; }
  /// A leaf's 512 values by offset; null for booleans, which leaves store as bits.
  [[nodiscard]] const ValueT* values(std::size_t leaf) const { return mLeaves[leaf].values; }
  [[nodiscard]] const std::vector<const Parent*>& parents() const { return mParents; }

  /// What lies in one place: a leaf, or (kNoLeaf) a tile.
  struct Place {
    std::int32_t leaf;
    ValueT tile;
  };

  /// The places around a block.
  class Around {
   public:
    Around(const LeafTable& table, const Coord& block)
        : mTable(table), mBlock(block), mParent(table.mParentIndex.find(parentOf(block))), mPlace(placeOf(block)) {
      mWithin = mParent >= 0;
      for (const std::int32_t c : block) mWithin = mWithin && (c & kMask) != 0 && (c & kMask) != kMask;
    }
    /// The place of block + (dx, dy, dz), each in [-1, 1].
    [[nodiscard]] Place operator()(int dx, int dy, int dz) const {
      if (mWithin) return mTable.placeIn(mParent, mPlace + dx * (1 << 2 * kLog2Places) + dy * (1 << kLog2Places) + dz);
      return mTable.findBeside(mParent, mBlock, dx, dy, dz);
    }

   private:
    const LeafTable& mTable;
    const Coord mBlock;
    const std::int32_t mParent;
    const int mPlace;
    bool mWithin;  ///< True if all of them lie in the block's own parent.
  };

 private:
  static constexpr int kMask = kPlaces - 1;
  static constexpr int kLog2Points = kLog2Places + LeafT::LOG2DIM;

  /// Parents about a parent, by 9(dx + 1) + 3(dy + 1) + dz + 1; where there is none, the value there.
  struct Neighbours {
    std::array<std::int32_t, 27> parent;
    std::array<ValueT, 27> tile;
  };
  struct Leaf {
    const LeafT* node;
    const ValueT* values;
    Coord coord;
  };

  static Coord parentOf(const Coord& b) { return {b[0] >> kLog2Places, b[1] >> kLog2Places, b[2] >> kLog2Places}; }

  [[nodiscard]] Place placeIn(std::int32_t parent, int place) const {
    const std::int32_t leaf = mPlaces[parent][place];
    return {leaf, leaf < 0 ? mParents[parent]->getTable()[place].getValue() : ValueT{}};
  }

  static int placeOf(const Coord& b) {
    return (b[0] & kMask) << 2 * kLog2Places | (b[1] & kMask) << kLog2Places | (b[2] & kMask);
  }

  [[nodiscard]] Place findBeside(std::int32_t parent, const Coord& b, int dx, int dy, int dz) const {
    const Coord c{b[0] + dx, b[1] + dy, b[2] + dz};
    if (parent < 0) return find(c);
    const int x = (b[0] & kMask) + dx, y = (b[1] & kMask) + dy, z = (b[2] & kMask) + dz;
    const int n = 13 + 9 * (x >> kLog2Places) + 3 * (y >> kLog2Places) + (z >> kLog2Places);
    const Neighbours& around = mAround[parent];
    if (n != 13 && around.parent[n] < 0) return {kNoLeaf, around.tile[n]};
    return placeIn(n == 13 ? parent : around.parent[n], placeOf(c));
  }

  [[nodiscard]] Place find(const Coord& block) const {
    const std::int32_t parent = mParentIndex.find(parentOf(block));
    if (parent < 0)
      return {kNoLeaf, mTree.getValue({block[0] * kBlockSize, block[1] * kBlockSize, block[2] * kBlockSize})};
    return placeIn(parent, placeOf(block));
  }

  void findNeighbours(const Coord& origin, Neighbours& around) const {
    for (int n = 0; n < 27; ++n) {
      const Coord c{origin[0] + n / 9 - 1, origin[1] + n / 3 % 3 - 1, origin[2] + n % 3 - 1};
      around.parent[n] = mParentIndex.find(c);
      around.tile[n] = around.parent[n] >= 0
                           ? ValueT{}
                           : mTree.getValue({c[0] << kLog2Points, c[1] << kLog2Points, c[2] << kLog2Points});
    }
  }

  void numberLeaves(std::size_t p, std::int32_t number) {
    mPlaces[p].fill(kNoLeaf);
    for (auto it = mParents[p]->cbeginChildOn(); it; ++it) {
      mPlaces[p][it.pos()] = number;
      mLeaves[number++].node = mParents[p]->getTable()[it.pos()].getChild();
    }
  }

  /// Every leaf lies in a page of its own, so that waiting for one after the other would take longer than all the rest.
  void readHeaders() {
    constexpr std::size_t kAhead = 16;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mLeaves.size(), 256), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        if (i + kAhead < range.end()) __builtin_prefetch(mLeaves[i + kAhead].node);
        Leaf& leaf = mLeaves[i];
        const openvdb::Coord o = leaf.node->origin();
        checkIndex(o);
        leaf.coord = blockOf({o.x(), o.y(), o.z()});
        leaf.values = nullptr;
        if constexpr (!std::is_same_v<ValueT, bool>) leaf.values = leaf.node->buffer().data();
      }
    });
  }

  const TreeT& mTree;
  std::vector<const Parent*> mParents;
  BlockIndex mParentIndex;
  Buffer<std::array<std::int32_t, Parent::NUM_VALUES>> mPlaces;
  Buffer<Neighbours> mAround;
  Buffer<Leaf> mLeaves;
};

}  // namespace pdc::detail
