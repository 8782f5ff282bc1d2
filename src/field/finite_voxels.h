#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/tree/LeafManager.h>
#include <tbb/parallel_reduce.h>

#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "field/non_finite.h"

namespace pdc::detail {

using NonFiniteVoxels = NonFinite<openvdb::Coord>;

template <typename Value>
bool isFiniteValue(const Value& value) {
  if constexpr (std::is_floating_point_v<Value>) return std::isfinite(value);
  return true;
}

/// Calls visit(i) for the entries of a node's table that are tiles and not finite.
template <typename Node, typename Visit>
void visitNonFiniteTiles(const Node& node, Visit&& visit) {
  const auto* table = node.getTable();
  const auto& children = node.getChildMask();
  for (openvdb::Index w = 0; w < Node::NUM_VALUES / 64; ++w) {
    const auto isChild = children.template getWord<std::uint64_t>(w);
    if (isChild == 0) {
      // Nearly all words hold tiles alone, and all of these are finite.
      unsigned finite = 1;
      for (openvdb::Index i = 64 * w; i < 64 * (w + 1); ++i) finite &= unsigned{isFiniteValue(table[i].getValue())};
      if (finite != 0) continue;
    }
    for (openvdb::Index i = 0; i < 64; ++i)
      if ((isChild >> i & 1) == 0 && !isFiniteValue(table[64 * w + i].getValue())) visit(64 * w + i);
  }
}

/// The tiles of a tree that are not finite, each as one voxel at its low corner. Tiles that hold the background do not
/// count.
template <typename Tree>
NonFiniteVoxels nonFiniteTiles(const Tree& tree) {
  NonFiniteVoxels found;
  if constexpr (!std::is_floating_point_v<typename Tree::ValueType>) return found;
  const bool countInactive = isFiniteValue(tree.background());
  const auto look = [&](const auto& value, bool active, const openvdb::Coord& at) {
    if (!isFiniteValue(value) && (active || countInactive)) found.add(at, static_cast<double>(value));
  };
  for (auto tile = tree.root().cbeginValueAll(); tile; ++tile) look(*tile, tile.isValueOn(), tile.getCoord());
  const auto lookInNodes = [&]<typename Node>(std::vector<const Node*> nodes) {
    tree.getNodes(nodes);
    for (const Node* node : nodes)
      visitNonFiniteTiles(*node, [&](openvdb::Index i) {
        look(node->getTable()[i].getValue(), node->isValueOn(i), node->offsetToGlobalCoord(i));
      });
  };
  using Upper = typename Tree::RootNodeType::ChildNodeType;
  lookInNodes(std::vector<const Upper*>());
  lookInNodes(std::vector<const typename Upper::ChildNodeType*>());
  return found;
}

/// Looks at every voxel of every leaf, in parallel, and at every tile. \throws Error if one is not finite.
template <typename Tree>
void requireFiniteVoxels(const Tree& tree) {
  if constexpr (!std::is_floating_point_v<typename Tree::ValueType>) return;
  const openvdb::tree::LeafManager<const Tree> leaves(tree);
  const NonFiniteVoxels inLeaves = tbb::parallel_reduce(
      leaves.leafRange(), NonFiniteVoxels(),
      [](const auto& range, NonFiniteVoxels found) {
        for (auto leaf = range.begin(); leaf; ++leaf)
          for (auto voxel = leaf->cbeginValueAll(); voxel; ++voxel)
            if (!isFiniteValue(*voxel)) found.add(voxel.getCoord(), static_cast<double>(*voxel));
        return found;
      },
      [](NonFiniteVoxels a, const NonFiniteVoxels& b) {
        a.add(b);
        return a;
      });
  NonFiniteVoxels found = nonFiniteTiles(tree);
  found.add(inLeaves);
  if (found.count == 0) return;
  const openvdb::Coord& at = found.first;
  failNonFinite(found.count, {"voxel", "voxels"}, fmt::format("({}, {}, {})", at.x(), at.y(), at.z()), found.value);
}

}  // namespace pdc::detail
