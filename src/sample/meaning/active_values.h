#pragma once

#include <openvdb/openvdb.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "sample/meaning/value_range.h"

namespace pdc::detail {

/// The range of a leaf's active values.
template <typename LeafT>
ValueRange rangeOf(const LeafT& leaf) {
  using Value = typename LeafT::ValueType;
  const Value* values = leaf.buffer().data();
  constexpr Value kLowest = std::numeric_limits<Value>::lowest(), kHighest = std::numeric_limits<Value>::max();
  Value low = kHighest, high = kLowest;
  for (openvdb::Index w = 0; w < LeafT::NodeMaskType::WORD_COUNT; ++w) {
    const std::uint64_t on = leaf.getValueMask().template getWord<std::uint64_t>(w);
    if (on == 0) continue;
    for (int i = 0; i < 64; ++i) {
      const Value v = values[64 * w + i];
      // Comparisons with NaN are false.
      const bool counts = (on >> i & 1) != 0 && v >= kLowest && v <= kHighest;
      low = counts && v < low ? v : low;
      high = counts && v > high ? v : high;
    }
  }
  return low <= high ? ValueRange{static_cast<double>(low), static_cast<double>(high)} : ValueRange{};
}

/// The active values of a tree. The tree must outlive this.
template <typename TreeT>
class ActiveValues {
 public:
  using LeafT = typename TreeT::LeafNodeType;

  /// Does not touch the leaves: each lies in a page of its own.
  explicit ActiveValues(const TreeT& tree) {
    std::vector<const Parent*> parents;
    tree.getNodes(parents);
    for (const Parent* node : parents) {
      for (auto child = node->cbeginChildOn(); child; ++child) mLeaves.push_back({child.getCoord(), &*child});
      addTiles(*node);
    }
    std::vector<const Grandparent*> grandparents;
    tree.getNodes(grandparents);
    for (const Grandparent* node : grandparents) addTiles(*node);
    for (auto tile = tree.root().cbeginValueOn(); tile; ++tile)
      mTiles.push_back({openvdb::CoordBBox::createCube(tile.getCoord(), Grandparent::DIM), static_cast<double>(*tile)});
  }

  /// Up to `most` leaves, spread over the tree.
  [[nodiscard]] std::vector<const LeafT*> someLeaves(std::size_t most) const {
    std::vector<const LeafT*> some(std::min(most, mLeaves.size()));
    for (std::size_t i = 0; i < some.size(); ++i) {
      const std::size_t begin = i * mLeaves.size() / some.size(), end = (i + 1) * mLeaves.size() / some.size();
      // Even steps would meet the same face of every row of a dense grid.
      const std::uint64_t hash = i * 0x9E3779B97F4A7C15 >> 32;
      some[i] = mLeaves[begin + hash % (end - begin)].node;
    }
    return some;
  }

  /// The range of all values, in parallel.
  [[nodiscard]] ValueRange range() const {
    ValueRange range = tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::size_t>(0, mLeaves.size(), 64), ValueRange{},
        [&](const auto& part, ValueRange sum) {
          for (std::size_t l = part.begin(); l != part.end(); ++l) sum.add(rangeOf(*mLeaves[l].node));
          return sum;
        },
        [](ValueRange a, const ValueRange& b) {
          a.add(b);
          return a;
        });
    for (const Tile& tile : mTiles) range.add(tile.value);
    return range;
  }

  /// Appends the finite values of the last layer across `axis` that has any, or of the first one, where counts(coord)
  /// says so.
  template <typename Counts>
  void outermost(int axis, bool last, const Counts& counts, std::vector<double>& values) const {
    const int sign = last ? 1 : -1;
    const auto farSide = [&](const openvdb::CoordBBox& box) {
      return std::int64_t{sign} * (last ? box.max() : box.min())[axis];
    };
    const int within = last ? kSide - 1 : 0;
    const auto farEnd = [&](const Leaf& leaf) { return sign * (std::int64_t{leaf.origin[axis]} + within); };
    std::int64_t reach = kNowhere;  // The layer's coordinate, times the sign.
    for (const Tile& tile : mTiles) reach = std::max(reach, farSide(tile.box));
    for (std::int64_t limit = -kNowhere; reach < limit;) {
      // All leaves that end in the same place, as far out as there are some below the limit.
      std::int64_t end = reach;
      for (const Leaf& leaf : mLeaves)
        if (const std::int64_t at = farEnd(leaf); at < limit) end = std::max(end, at);
      for (const Leaf& leaf : mLeaves)
        if (farEnd(leaf) == end) reach = std::max(reach, reachOf(leaf, axis, sign));
      limit = end;
    }
    for (const Tile& tile : mTiles)
      if (farSide(tile.box) == reach && std::isfinite(tile.value) && counts(tile.box.min()))
        values.push_back(tile.value);
    for (const Leaf& leaf : mLeaves) {
      const std::int64_t layer = sign * reach - leaf.origin[axis];
      if (layer >= 0 && layer < kSide) appendLayer(*leaf.node, axis, static_cast<int>(layer), counts, values);
    }
  }

 private:
  using Grandparent = typename TreeT::RootNodeType::ChildNodeType;
  using Parent = typename Grandparent::ChildNodeType;
  static constexpr int kSide = LeafT::DIM;
  static constexpr std::int64_t kNowhere = -(std::int64_t{1} << 40);  ///< Beyond all coordinates.

  struct Leaf {
    openvdb::Coord origin;
    const LeafT* node;
  };
  struct Tile {
    openvdb::CoordBBox box;
    double value;
  };

  template <typename Node>
  void addTiles(const Node& node) {
    for (auto tile = node.cbeginValueOn(); tile; ++tile)
      mTiles.push_back(
          {openvdb::CoordBBox::createCube(tile.getCoord(), Node::ChildNodeType::DIM), static_cast<double>(*tile)});
  }

  /// Calls visit(offset) for the active values of a leaf's layer until it returns true; \returns whether it did.
  template <typename Visit>
  static bool visitLayer(const LeafT& leaf, int axis, int layer, Visit&& visit) {
    constexpr int kStep[3] = {kSide * kSide, kSide, 1};
    const int u = kStep[(axis + 1) % 3], v = kStep[(axis + 2) % 3];
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const auto offset = static_cast<openvdb::Index>(layer * kStep[axis] + i * u + j * v);
        if (leaf.isValueOn(offset) && visit(offset)) return true;
      }
    return false;
  }
  /// How far a leaf's active values reach along `sign` times an axis.
  static std::int64_t reachOf(const Leaf& leaf, int axis, int sign) {
    for (int i = 0; i < kSide; ++i) {
      const int layer = sign > 0 ? kSide - 1 - i : i;
      if (visitLayer(*leaf.node, axis, layer, [](openvdb::Index) { return true; }))
        return sign * (std::int64_t{leaf.origin[axis]} + layer);
    }
    return kNowhere;
  }
  template <typename Counts>
  static void appendLayer(const LeafT& leaf, int axis, int layer, const Counts& counts, std::vector<double>& values) {
    visitLayer(leaf, axis, layer, [&](openvdb::Index offset) {
      const auto v = static_cast<double>(leaf.getValue(offset));
      if (std::isfinite(v) && counts(leaf.offsetToGlobalCoord(offset))) values.push_back(v);
      return false;
    });
  }

  std::vector<Leaf> mLeaves;
  std::vector<Tile> mTiles;
};

}  // namespace pdc::detail
