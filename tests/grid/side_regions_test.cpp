#include "grid/side_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>

namespace pdc::detail {
namespace {

using openvdb::Coord;

/// A cube of leaves, 24 voxels along each axis, with tiles in the place of some; `inside` says what is inside.
TreeSides cubeOf(const std::function<bool(const Coord&)>& inside, const std::set<int>& tiles = {}) {
  TreeSides sides;
  int n = 0;
  for (const Coord& block : openvdb::CoordBBox(Coord(-1), Coord(1))) {
    const Coord origin(8 * block.x(), 8 * block.y(), 8 * block.z());
    if (tiles.contains(n++)) {
      sides.tiles.push_back({origin, 8, inside(origin)});
      continue;
    }
    LeafSides leaf{.origin = origin};
    for (std::uint32_t v = 0; v < 512; ++v)
      if (inside(origin + Coord(static_cast<int>(v / 64), static_cast<int>(v / 8 % 8), static_cast<int>(v % 8))))
        leaf.inside[v / 64] |= std::uint64_t{1} << v % 64;
    sides.leaves.push_back(leaf);
  }
  return sides;
}

/// Sizes of the parts of one side within 24³ voxels, those of the outside that reach the border left out, by flooding.
std::vector<std::uint64_t> flooded(const std::function<bool(const Coord&)>& inside, bool side) {
  const openvdb::CoordBBox box(Coord(-8), Coord(15));
  std::set<Coord> left;
  for (const Coord& c : box)
    if (inside(c) == side) left.insert(c);
  std::vector<std::uint64_t> sizes;
  while (!left.empty()) {
    std::vector<Coord> queue{*left.begin()};
    left.erase(left.begin());
    bool beyond = false;
    for (std::size_t i = 0; i < queue.size(); ++i)
      for (int face = 0; face < 6; ++face) {
        Coord next = queue[i];
        next[face / 2] += face % 2 == 0 ? 1 : -1;
        if (!box.isInside(next)) beyond = true;
        if (left.erase(next) > 0) queue.push_back(next);
      }
    if (side || !beyond) sizes.push_back(queue.size());
  }
  std::sort(sizes.rbegin(), sizes.rend());
  return sizes;
}

TEST(SideRegions, AreThoseOfAFlood) {
  for (const double share : {0.2, 0.35, 0.5, 0.7}) {
    std::mt19937 random(3);
    std::map<Coord, bool> bits;
    const std::set<int> tiles{0, 5, 13, 14, 26};
    // A tile is of one side as a whole.
    for (const Coord& c : openvdb::CoordBBox(Coord(-8), Coord(15))) {
      const Coord block = Coord(c.x() >> 3, c.y() >> 3, c.z() >> 3) + Coord(1);
      const int n = 9 * block.x() + 3 * block.y() + block.z();
      const bool bit = std::uniform_real_distribution<>(0, 1)(random) < share;
      bits[c] = tiles.contains(n) ? n % 2 == 0 : bit;
    }
    const auto inside = [&](const Coord& c) { return bits.at(c); };
    const TreeSides sides = cubeOf(inside, tiles);
    EXPECT_EQ(sides.tiles.size(), tiles.size());
    EXPECT_EQ(SideRegions(sides, true).sizes(), flooded(inside, true)) << share;
    EXPECT_EQ(SideRegions(sides, false).sizes(), flooded(inside, false)) << share;
  }
}

TEST(SideRegions, SayWhichPartAVoxelIsOf) {
  // Two bars along z through all leaves, of 4 and of 9 voxels across.
  const auto inside = [](const Coord& c) {
    return (c.x() >= -8 && c.x() < -6 && c.y() >= 0 && c.y() < 2) ||
           (c.x() >= 6 && c.x() < 9 && c.y() >= 6 && c.y() < 9);
  };
  const TreeSides sides = cubeOf(inside);
  const SideRegions parts(sides, true), gaps(sides, false);
  EXPECT_EQ(parts.sizes(), (std::vector<std::uint64_t>{9 * 24, 4 * 24}));
  EXPECT_TRUE(gaps.sizes().empty());
  for (std::size_t l = 0; l < sides.leaves.size(); ++l)
    for (std::uint32_t v = 0; v < 512; ++v) {
      const int x = sides.leaves[l].origin.x() + static_cast<int>(v / 64);
      if ((sides.leaves[l].inside[v / 64] >> v % 64 & 1) != 0) {
        EXPECT_EQ(parts.ofVoxel(l, v), x < 0 ? 1u : 0u);
      } else {
        EXPECT_EQ(gaps.ofVoxel(l, v), SideRegions::kBeyond);
      }
    }
}

TEST(SideRegions, LargeTilesMeetSmallOnes) {
  // A tile of 128 voxels, one of 8 beside it, a leaf beside that, and one apart.
  TreeSides sides;
  sides.tiles = {{Coord(0), 128, true}, {Coord(128, 120, 120), 8, true}, {Coord(256, 0, 0), 8, true}};
  LeafSides leaf{.origin = Coord(136, 120, 120)};
  leaf.inside[0] = 1;
  leaf.inside[7] = 1;
  sides.leaves = {leaf};
  const SideRegions parts(sides, true);
  EXPECT_EQ(parts.sizes(), (std::vector<std::uint64_t>{128 * 128 * 128 + 512 + 1, 512, 1}));
  EXPECT_EQ(parts.ofVoxel(0, 0), 0u);
  EXPECT_EQ(parts.ofVoxel(0, 448), 2u);
  EXPECT_EQ(parts.ofTile(1), 0u);
  EXPECT_EQ(parts.ofTile(2), 1u);
}

}  // namespace
}  // namespace pdc::detail
