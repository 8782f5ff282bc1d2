#include "sample/stencils/isovalue_points.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <memory>
#include <random>

#include "pdc/extract/contour.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc::detail {
namespace {

TEST(PointsBetween, AreThoseWithBothNeighboursAlongAnAxis) {
  std::mt19937_64 engine(1);
  CellMask own;
  std::array<CellMask, 6> around;
  for (std::uint64_t& w : own.word) w = engine();
  for (CellMask& m : around)
    for (std::uint64_t& w : m.word) w = engine();
  const auto at = [&](int x, int y, int z) {
    const std::array<int, 3> p{x, y, z};
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] < 0) return around[2 * axis].test(x & 7, y & 7, z & 7);
      if (p[axis] >= kBlockSize) return around[2 * axis + 1].test(x & 7, y & 7, z & 7);
    }
    return own.test(x, y, z);
  };
  const CellMask between = pointsBetween(own, around);
  for (int x = 0; x < kBlockSize; ++x)
    for (int y = 0; y < kBlockSize; ++y)
      for (int z = 0; z < kBlockSize; ++z)
        ASSERT_EQ(between.test(x, y, z), (at(x - 1, y, z) && at(x + 1, y, z)) || (at(x, y - 1, z) && at(x, y + 1, z)) ||
                                             (at(x, y, z - 1) && at(x, y, z + 1)))
            << x << ' ' << y << ' ' << z;
}

class IsovaluePoints : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }

  /// Values -1, 0 and 1 in [0, size)³, 1 around.
  static openvdb::FloatGrid::Ptr randomGrid(int size) {
    auto grid = openvdb::FloatGrid::create(1);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    std::mt19937 engine(2);
    std::discrete_distribution<int> value({3, 3, 2});
    auto accessor = grid->getAccessor();
    for (int x = 0; x < size; ++x)
      for (int y = 0; y < size; ++y)
        for (int z = 0; z < size; ++z) accessor.setValue({x, y, z}, static_cast<float>(value(engine) - 1));
    return grid;
  }

  /// The rule, point by point.
  static bool inside(const openvdb::FloatGrid& grid, const openvdb::Coord& p) {
    const auto below = [&](int axis, int step) {
      openvdb::Coord q = p;
      q[axis] += step;
      return grid.tree().getValue(q) < 0;
    };
    const float v = grid.tree().getValue(p);
    if (v != 0) return v < 0;
    for (int axis = 0; axis < 3; ++axis)
      if (below(axis, -1) && below(axis, 1)) return true;
    return false;
  }
};

TEST_F(IsovaluePoints, AreInsideBetweenTwoThatAre) {
  const auto grid = randomGrid(20);
  const GridSource source(grid, {});
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  ASSERT_FALSE(blocks.coords.empty());
  for (std::size_t b = 0; b < blocks.coords.size(); ++b)
    for (int x = 0; x < kBlockPoints; ++x)
      for (int y = 0; y < kBlockPoints; ++y)
        for (int z = 0; z < kBlockPoints; ++z) {
          const Coord& c = blocks.coords[b];
          const openvdb::Coord p(8 * c[0] + x, 8 * c[1] + y, 8 * c[2] + z);
          ASSERT_EQ(blocks.signs[b].inside(x, y, z), inside(*grid, p)) << p;
        }
}

TEST_F(IsovaluePoints, WithHigherInsideTheRuleIsTheSame) {
  const auto grid = randomGrid(12);
  for (auto it = grid->beginValueOn(); it; ++it) it.setValue(-*it);
  const auto mirrored = openvdb::FloatGrid::create(-1);
  mirrored->setTree(grid->treePtr());
  mirrored->setGridClass(openvdb::GRID_FOG_VOLUME);
  mirrored->tree().root().setBackground(-1, true);
  const SurfaceBlocks low = GridSource(randomGrid(12), {}).surfaceBlocks({});
  const SurfaceBlocks high = GridSource(mirrored, {.iso = 0.0}).surfaceBlocks({});
  ASSERT_EQ(low.coords, high.coords);
  for (std::size_t i = 0; i < low.coords.size(); ++i) EXPECT_EQ(low.signs[i].row, high.signs[i].row);
}

TEST_F(IsovaluePoints, ACrossingBetweenTwoZerosLiesAtItsOutsideEnd) {
  // The zero at the origin lies between two insides; the zero above it does not.
  auto grid = openvdb::FloatGrid::create(1);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto accessor = grid->getAccessor();
  accessor.setValue({1, 2, 2}, -1);
  accessor.setValue({2, 2, 2}, 0);
  accessor.setValue({3, 2, 2}, -1);
  accessor.setValue({2, 2, 3}, 0);
  const GridSource source(grid, {});
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  ASSERT_EQ(blocks.coords.size(), 1u);
  const EdgeIndex edges(blocks.signs[0]);
  const auto hermite = std::make_unique<HermiteBlock>();
  source.fillHermite({blocks.coords[0], blocks.signs[0], edges}, *hermite);
  EXPECT_EQ(hermite->t[edges(kAxisZ, 2, 2, 2)], 1);
  // Its value counts as -1, half-way to the 1 beyond it.
  EXPECT_EQ(hermite->t[edges(kAxisY, 2, 2, 2)], 0.5F);
  EXPECT_EQ(hermite->t[edges(kAxisY, 2, 1, 2)], 0.5F);
}

TEST_F(IsovaluePoints, BoxesThatTouchInALayerOfPointsAreOne) {
  // The distance to the nearer of [-6, 0] x [-5, 5]² and [0, 6] x [-5, 5]²; the faces do not lie on the lattice.
  auto grid = openvdb::FloatGrid::create(3);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto accessor = grid->getAccessor();
  const auto boxDistance = [](double x, double y, double z) {
    return static_cast<float>(std::max({std::abs(std::abs(x) - 3.15) - 3.15, std::abs(y) - 5.3, std::abs(z) - 5.3}));
  };
  for (int x = -9; x <= 9; ++x)
    for (int y = -9; y <= 9; ++y)
      for (int z = -9; z <= 9; ++z) accessor.setValue({x, y, z}, std::clamp(boxDistance(x, y, z), -3.0F, 3.0F));
  ASSERT_EQ(grid->tree().getValue({0, 0, 0}), 0);
  for (const HermiteMode mode : {HermiteMode::kGradient, HermiteMode::kDistance}) {
    const MeshReport report = analyze(contour(GridSource(grid, {.hermite = mode})));
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.eulerNumber, 2);
    const double exact = 12.6 * 10.6 * 10.6;
    EXPECT_NEAR(report.volume, exact, (mode == HermiteMode::kDistance ? 0.001 : 0.01) * exact);
  }
}

}  // namespace
}  // namespace pdc::detail
