#include "grid/flip_parts.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "grid/real_grid.h"
#include "grid/side_regions.h"
#include "grid/trim_band.h"
#include "parallel/for_each_in_parallel.h"

namespace pdc::detail {
namespace {

/// Calls visit(iterator) for all tiles, active or not, in the order of the tree.
template <typename TreeT, typename Visit>
void forEachTile(TreeT& tree, const Visit& visit) {
  auto tile = tree.beginValueAll();
  tile.setMaxDepth(decltype(tile)::LEAF_DEPTH - 1);
  for (; tile; ++tile) visit(tile);
}

template <typename TreeT>
class Flip {
 public:
  using Leaf = typename TreeT::LeafNodeType;
  using Value = typename TreeT::ValueType;

  Flip(TreeT& tree, double iso, bool high) : mTree(tree), mIso(static_cast<Value>(iso)), mHigh(high) {
    mTree.getNodes(mLeaves);
  }

  [[nodiscard]] TreeSides sides() const {
    TreeSides sides;
    sides.leaves.resize(mLeaves.size());
    forEachInParallel(mLeaves.size(), 64, [&](std::uint32_t l) {
      LeafSides& leaf = sides.leaves[l];
      leaf.origin = mLeaves[l]->origin();
      for (openvdb::Index v = 0; v < Leaf::SIZE; ++v)
        if (isInside(mLeaves[l]->getValue(v))) leaf.inside[v / 64] |= std::uint64_t{1} << v % 64;
    });
    forEachTile(mTree, [&](const auto& tile) {
      sides.tiles.push_back({tile.getBoundingBox().min(), tile.getBoundingBox().dim().x(), isInside(*tile)});
    });
    return sides;
  }

  /// Mirrors the values of the parts that are set in `flipped`.
  void run(const TreeSides& sides, const SideRegions& parts, bool inside, const std::vector<char>& flipped) {
    const auto wanted = [&](std::uint32_t part) { return part != SideRegions::kBeyond && flipped[part] != 0; };
    forEachInParallel(mLeaves.size(), 64, [&](std::uint32_t l) {
      for (std::uint32_t v = 0; v < Leaf::SIZE; ++v) {
        const Value value = mLeaves[l]->getValue(v);
        if (isInside(value) == inside && wanted(parts.ofVoxel(l, v))) mLeaves[l]->setValueOnly(v, mirrored(value));
      }
    });
    std::size_t t = 0;
    forEachTile(mTree, [&](const auto& tile) {
      if (sides.tiles[t].inside == inside && wanted(parts.ofTile(t))) tile.setValue(mirrored(*tile));
      ++t;
    });
  }

 private:
  [[nodiscard]] bool isInside(Value value) const { return mHigh ? value > mIso : value < mIso; }
  /// What is the isovalue is outside, and what replaces it must not be.
  [[nodiscard]] Value mirrored(Value value) const {
    const Value other = 2 * mIso - value;
    if (other != mIso) return other;
    return std::nextafter(mIso, mHigh ? std::numeric_limits<Value>::max() : std::numeric_limits<Value>::lowest());
  }

  TreeT& mTree;
  Value mIso;
  bool mHigh;
  std::vector<Leaf*> mLeaves;
};

}  // namespace

FlippedParts flipParts(GridVolume& volume, bool inside, const std::function<bool(std::size_t, std::uint64_t)>& flips) {
  FlippedParts result;
  visitReal(volume, "flipParts", [&](auto& grid) {
    using Tree = typename std::decay_t<decltype(grid)>::TreeType;
    Flip<Tree> flip(grid.tree(), volume.iso, volume.inside == InsideValues::kHigh);
    const TreeSides sides = flip.sides();
    const SideRegions parts(sides, inside);
    std::vector<char> flipped(parts.sizes().size());
    for (std::size_t i = 0; i < flipped.size(); ++i) flipped[i] = flips(i, parts.sizes()[i]) ? 1 : 0;
    result.before = flipped.size();
    result.flipped = static_cast<std::size_t>(std::count(flipped.begin(), flipped.end(), 1));
    if (result.flipped > 0) flip.run(sides, parts, inside, flipped);
  });
  if (result.flipped > 0 && volume.iso == 0) trimBand(volume);
  return result;
}

}  // namespace pdc::detail
