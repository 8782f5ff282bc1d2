#include "sample/mesh/lattice_crossings.h"

#include <gtest/gtest.h>

#include "mesh/winding/cubes.h"

namespace pdc::detail {
namespace {

/// Planes of the lattice go through all sides of the cube.
const MeshLattice kOnSides{.origin = {-0.5, -0.5, -0.5}, .voxelSize = 0.25};

TEST(LatticeCrossings, TurnsAddUpAroundEverySquare) {
  const ClosedSurface cube = closeSurface(test::cube());
  std::vector<LatticeCrossings> along;
  for (const Axis axis : kAxes) along.emplace_back(cube, cube.own, kOnSides, axis, Monitor{});
  const auto turn = [&](Axis axis, const Coord& point) {
    int sum = 0;
    for (const EdgeCrossing& c : along[axis].along(point, 1)) sum += c.turn;
    return sum;
  };
  int met = 0;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z)
        for (const Axis axis : kAxes) {
          const Axis u = nextAxis(axis), v = previousAxis(axis);
          const Coord p{x, y, z};
          Coord pu = p, pv = p;
          ++pu[u];
          ++pv[v];
          EXPECT_EQ(turn(u, p) + turn(v, pu) - turn(u, pv) - turn(v, p), 0);
          met += turn(axis, p) != 0 ? 1 : 0;
        }
  EXPECT_EQ(met, 6 * 16);
}

TEST(LatticeWinding, CountsFromOutside) {
  const ClosedSurface cube = closeSurface(test::cube());
  const LatticeCrossings crossings(cube, cube.own, kOnSides, kAxisZ, {});
  const LatticeWinding winding(crossings);
  for (int x = -1; x < 9; ++x)
    for (int y = -1; y < 9; ++y)
      for (int z = -1; z < 9; ++z) {
        const auto within = [](int k) { return k >= 2 && k < 6; };
        EXPECT_EQ(winding.at({x, y, z}), within(x) && within(y) && within(z) ? 1 : 0) << x << ' ' << y << ' ' << z;
      }
}

}  // namespace
}  // namespace pdc::detail
