#include "mesh/winding/lattice_line.h"

#include <gtest/gtest.h>

#include "mesh/winding/cubes.h"

namespace pdc::detail {
namespace {

std::array<Vec3d, 3> points(const Mesh& mesh, const Triangle& t) {
  return {vecCast<double>(mesh.positions[t[0]]), vecCast<double>(mesh.positions[t[1]]),
          vecCast<double>(mesh.positions[t[2]])};
}

TEST(PassThrough, LinesEnterACubeAsOftenAsTheyLeaveIt) {
  const Mesh mesh = test::cube();
  int through = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int u = -1; u <= 3; ++u)
      for (int v = -1; v <= 3; ++v) {
        Vec3d p{};
        p[(axis + 1) % 3] = 0.5 * u;
        p[(axis + 2) % 3] = 0.5 * v;
        int sum = 0, met = 0;
        for (const Triangle& t : mesh.triangles) {
          const int turn = passThrough(p, axis, points(mesh, t));
          sum += turn;
          met += turn != 0 ? 1 : 0;
        }
        EXPECT_EQ(sum, 0);
        EXPECT_TRUE(met == 0 || met == 2) << met;
        through += met / 2;
      }
  // Lines on the lower sides are inside and those on the upper ones outside, each counted once: 2 of 5 each way.
  EXPECT_EQ(through, 3 * 4);
}

TEST(PassThrough, TrianglesAlongTheLineAreNotMet) {
  EXPECT_EQ(passThrough({0.25, 0.25, 0}, 2, {Vec3d{0, 0.25, 0}, {1, 0.25, 0}, {1, 0.25, 1}}), 0);
  EXPECT_EQ(passThrough({0.25, 0.25, 0}, 2, {Vec3d{0, 0, 0}, {1, 1, 0}, {0, 0, 0}}), 0);
}

TEST(SideOfPlane, IsDecidedOnThePlaneToo) {
  const std::array<Vec3d, 3> up{Vec3d{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, down{up[0], up[2], up[1]};
  EXPECT_EQ(sideOfPlane({0.1, 0.1, 0.1}, up), 1);
  EXPECT_EQ(sideOfPlane({0.1, 0.1, -0.1}, up), -1);
  EXPECT_EQ(sideOfPlane({0.1, 0.1, 0}, up), 1);
  EXPECT_EQ(sideOfPlane({0.1, 0.1, 0}, down), -1);
  EXPECT_EQ(sideOfPlane({0.1, 0.1, 0}, {up[0], up[1], up[1]}), 0);
}

}  // namespace
}  // namespace pdc::detail
