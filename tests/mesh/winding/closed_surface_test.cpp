#include "mesh/winding/closed_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "mesh/winding/cubes.h"

namespace pdc::detail {
namespace {

/// How often more triangles run along each edge than against it, where that is not 0.
std::size_t edgesThatDoNotCancel(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sums;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      sums[std::minmax({a, b})] += a < b ? 1 : -1;
    }
  return static_cast<std::size_t>(std::count_if(sums.begin(), sums.end(), [](const auto& s) { return s.second != 0; }));
}

TEST(CloseSurface, ClosedMeshesNeedNoCaps) {
  EXPECT_TRUE(closeSurface(test::cube()).caps().empty());
  EXPECT_TRUE(closeSurface(test::insideOut(test::cube())).caps().empty());
}

TEST(CloseSurface, CapsCloseWhateverIsOpen) {
  Mesh fan;  // Three triangles at one edge, and one of them twice.
  fan.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
  fan.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 4}};
  Mesh turned = test::cube();
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  for (const Mesh& mesh : {test::openCube(), fan, turned}) {
    const ClosedSurface closed = closeSurface(mesh);
    EXPECT_EQ(closed.own, mesh.triangles.size());
    EXPECT_GT(closed.caps().size(), 0U);
    EXPECT_EQ(edgesThatDoNotCancel(closed.surface), 0U);
  }
}

TEST(CloseSurface, LoopsThatMeetInAVertexHaveCapsOfTheirOwn) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  const ClosedSurface closed = closeSurface(mesh);
  EXPECT_EQ(closed.caps().size(), 6U);
  EXPECT_EQ(closed.surface.positions.size(), 7U);
}

TEST(CloseSurface, CracksOfRoundingAreWelded) {
  Mesh mesh = test::cube();
  mesh.positions.push_back({std::nextafter(1.0F, 2.0F), 1, 1});
  mesh.triangles.back()[1] = 8;
  EXPECT_TRUE(closeSurface(mesh).caps().empty());
}

TEST(CloseSurface, TrianglesWithoutAPlaceAreLeftOut) {
  Mesh mesh = test::cube();
  mesh.positions.push_back({0, std::numeric_limits<float>::quiet_NaN(), 0});
  mesh.triangles.push_back({0, 1, 8});
  mesh.triangles.push_back({0, 1, 1});
  const ClosedSurface closed = closeSurface(mesh);
  EXPECT_EQ(closed.own, 12U);
  EXPECT_TRUE(closed.caps().empty());
}

}  // namespace
}  // namespace pdc::detail
