#pragma once

#include <openvdb/tree/LeafManager.h>
#include <tbb/parallel_for.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "field/interval_arithmetic.h"

namespace pdc::detail {

/// A range without values, for include() to fill: lo > hi.
inline constexpr Interval kEmptyRange{std::numeric_limits<double>::infinity(),
                                      -std::numeric_limits<double>::infinity()};

/// Grows the range to hold the value; NaN and infinite ones leave no trace.
inline void include(Interval& range, double value) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  range.lo = value < range.lo && value >= -kLargest ? value : range.lo;
  range.hi = value > range.hi && value <= kLargest ? value : range.hi;
}

/// Smallest and largest voxel of any index box, from the stored ranges of cubes with edges of 8, 16, 32... voxels.
///
/// Only cubes that are not all of one value are stored, so memory grows with the number of leaves. The tree must not
/// change.
template <typename Tree>
class VoxelRanges {
 public:
  explicit VoxelRanges(const Tree& tree) : mTree(&tree) {
    insertLeaves();
    insertTiles();
    // Levels are added until one is so small that it can be searched entry by entry.
    for (std::size_t level = 0; level + 1 < mLevels.size() || mLevels[level].size() > kSmallLevel; ++level) {
      if (level + 1 == mLevels.size()) mLevels.emplace_back();
      insertParents(level);
    }
  }

  /// The range of the voxels in [lo, hi], both included, and perhaps of some around them; empty if none is
  /// finite.
  [[nodiscard]] Interval range(const openvdb::Coord& lo, const openvdb::Coord& hi) const {
    std::size_t level = 0;
    while (level < mLevels.size() && !fewCubes(cubeOf(lo, level), cubeOf(hi, level))) ++level;
    if (level == mLevels.size()) return rangeFromTop(lo, hi);
    const openvdb::Coord first = cubeOf(lo, level), last = cubeOf(hi, level);
    const typename Accessor::Type accessor(*mTree);
    Interval range = kEmptyRange;
    for (int x = first.x(); x <= last.x(); ++x)
      for (int y = first.y(); y <= last.y(); ++y)
        for (int z = first.z(); z <= last.z(); ++z) range = hull(range, cubeRange(level, {x, y, z}, accessor));
    return range;
  }

 private:
  struct Accessor {
    using Type = openvdb::tree::ValueAccessor<const Tree, false>;
  };
  struct Hash {
    std::size_t operator()(const openvdb::Coord& c) const {
      std::uint64_t h = 0;
      for (int i = 0; i < 3; ++i) h = (h ^ static_cast<std::uint32_t>(c[i])) * 0x9e3779b97f4a7c15U;
      return h ^ (h >> 32);
    }
  };
  using Level = std::unordered_map<openvdb::Coord, Interval, Hash>;

  static constexpr std::size_t kLeafLog2 = Tree::LeafNodeType::LOG2DIM;
  static constexpr std::size_t kSmallLevel = 8;
  static constexpr int kCubesPerAxis = 4;  ///< A box is looked up cube by cube on the first level of so few.

  /// The cube that holds a voxel, for negative coordinates too, because shifts round down.
  static openvdb::Coord cubeOf(const openvdb::Coord& voxel, std::size_t level) {
    const auto shift = static_cast<int>(kLeafLog2 + level);
    return {voxel.x() >> shift, voxel.y() >> shift, voxel.z() >> shift};
  }

  static bool fewCubes(const openvdb::Coord& first, const openvdb::Coord& last) {
    bool few = true;
    for (int i = 0; i < 3; ++i) few = few && std::int64_t{last[i]} - first[i] < kCubesPerAxis;
    return few;
  }

  /// A cube without an entry lies in one tile, or in the background, and has one value.
  [[nodiscard]] Interval cubeRange(std::size_t level, const openvdb::Coord& cube,
                                   const typename Accessor::Type& accessor) const {
    const auto found = mLevels[level].find(cube);
    if (found != mLevels[level].end()) return found->second;
    const auto shift = static_cast<int>(kLeafLog2 + level);
    Interval range = kEmptyRange;
    include(range, accessor.getValue({cube.x() << shift, cube.y() << shift, cube.z() << shift}));
    return range;
  }

  [[nodiscard]] Interval rangeFromTop(const openvdb::Coord& lo, const openvdb::Coord& hi) const {
    const std::size_t level = mLevels.size() - 1;
    const openvdb::Coord first = cubeOf(lo, level), last = cubeOf(hi, level);
    Interval range = kEmptyRange;
    include(range, mTree->background());
    for (const auto& [cube, cubeRange] : mLevels[level]) {
      bool inside = true;
      for (int i = 0; i < 3; ++i) inside = inside && first[i] <= cube[i] && cube[i] <= last[i];
      if (inside) range = hull(range, cubeRange);
    }
    return range;
  }

  void insertLeaves() {
    const openvdb::tree::LeafManager<const Tree> leaves(*mTree);
    std::vector<Interval> ranges(leaves.leafCount(), kEmptyRange);
    tbb::parallel_for(std::size_t{0}, ranges.size(), [&](std::size_t i) {
      const auto* values = leaves.leaf(i).buffer().data();
      for (openvdb::Index k = 0; k < Tree::LeafNodeType::SIZE; ++k) include(ranges[i], values[k]);
    });
    mLevels.emplace_back();
    mLevels[0].reserve(ranges.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) mLevels[0].emplace(cubeOf(leaves.leaf(i).origin(), 0), ranges[i]);
  }

  void insertTiles() {
    auto tile = mTree->cbeginValueAll();
    tile.setMaxDepth(Tree::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
      if (*tile == mTree->background()) continue;
      openvdb::CoordBBox box;
      tile.getBoundingBox(box);
      const auto level = static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(box.dim().x())) - 1) - kLeafLog2;
      if (mLevels.size() <= level) mLevels.resize(level + 1);
      Interval range = kEmptyRange;
      include(range, *tile);
      mLevels[level].emplace(cubeOf(box.min(), level), range);
    }
  }

  void insertParents(std::size_t level) {
    const typename Accessor::Type accessor(*mTree);
    for (const auto& entry : mLevels[level]) {
      const openvdb::Coord parent(entry.first.x() >> 1, entry.first.y() >> 1, entry.first.z() >> 1);
      const auto [place, isNew] = mLevels[level + 1].try_emplace(parent, kEmptyRange);
      if (!isNew) continue;
      for (int i = 0; i < 8; ++i) {
        const openvdb::Coord child(2 * parent.x() + (i & 1), 2 * parent.y() + (i >> 1 & 1), 2 * parent.z() + (i >> 2));
        place->second = hull(place->second, cubeRange(level, child, accessor));
      }
    }
  }

  const Tree* mTree;
  std::vector<Level> mLevels;  ///< Keyed by cubeOf(); the cubes of level n have edges of 8·2ⁿ voxels.
};

}  // namespace pdc::detail
