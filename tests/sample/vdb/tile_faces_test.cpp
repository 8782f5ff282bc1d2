#include "sample/vdb/tile_faces.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <random>
#include <set>

namespace pdc::detail {
namespace {

using openvdb::FloatTree;

constexpr float kInside = -1, kOutside = 1;

class TileFacesTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }

  static std::set<Coord> find(const FloatTree& tree) {
    const ValueReader<float> reader(ValueReading{});
    std::vector<Coord> blocks;
    TileFaces<FloatTree>(tree, reader).find({}, blocks);
    return {blocks.begin(), blocks.end()};
  }

  /// What find() should give where all tiles inside lie within blocks low to high: looks at each pair of neighbours.
  static std::set<Coord> findPlainly(const FloatTree& tree, const Coord& low, const Coord& high) {
    const auto isTile = [&](const Coord& b, float value) {
      const openvdb::Coord p(8 * b[0], 8 * b[1], 8 * b[2]);
      return tree.probeConstLeaf(p) == nullptr && tree.getValue(p) == value;
    };
    std::set<Coord> blocks;
    for (int x = low[0] - 1; x <= high[0]; ++x)
      for (int y = low[1] - 1; y <= high[1]; ++y)
        for (int z = low[2] - 1; z <= high[2]; ++z)
          for (int axis = 0; axis < 3; ++axis) {
            const Coord lower{x, y, z};
            Coord upper = lower;
            ++upper[axis];
            if (!(isTile(lower, kInside) && isTile(upper, kOutside)) &&
                !(isTile(lower, kOutside) && isTile(upper, kInside)))
              continue;
            // Four rows of cells have edges that cross the face.
            for (int i = 0; i < 4; ++i) {
              Coord cells = lower;
              cells[(axis + 1) % 3] -= i & 1;
              cells[(axis + 2) % 3] -= i >> 1;
              blocks.insert(cells);
            }
          }
    return blocks;
  }
};

TEST_F(TileFacesTest, AreThoseThatALookAtEachPairOfTilesFinds) {
  // Two neighbouring nodes of 16³ leaf-sized places, so that faces lie in them and between them.
  constexpr int kSpan = 16;
  for (const double share : {0.02, 0.3, 0.9}) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> chance(0, 1);
    FloatTree tree(kOutside);
    for (int x = 0; x < kSpan; ++x)
      for (int y = 0; y < kSpan; ++y)
        for (int z = -kSpan; z < kSpan; ++z) {
          const openvdb::Coord p(8 * x, 8 * y, 8 * z);
          if (chance(random) < 0.1) {
            tree.touchLeaf(p);
          } else {
            tree.addTile(1, p, chance(random) < share ? kInside : kOutside, chance(random) < 0.5);
          }
        }
    const std::set<Coord> expected = findPlainly(tree, {0, 0, -kSpan}, {kSpan - 1, kSpan - 1, kSpan - 1});
    EXPECT_GT(expected.size(), 100u);
    EXPECT_EQ(find(tree), expected) << share;
  }
}

TEST_F(TileFacesTest, OfLargeTilesAreFoundBesideSmallOnes) {
  FloatTree tree(kOutside);
  tree.addTile(2, openvdb::Coord(0, 0, 0), kInside, true);
  tree.addTile(1, openvdb::Coord(128, 64, 64), kInside, true);
  tree.addTile(1, openvdb::Coord(128, 64, 0), kOutside, true);
  tree.touchLeaf(openvdb::Coord(-8, 0, 0));
  const std::set<Coord> expected = findPlainly(tree, {0, 0, 0}, {16, 15, 15});
  EXPECT_GT(expected.size(), 1000u);
  EXPECT_EQ(find(tree), expected);
}

}  // namespace
}  // namespace pdc::detail
