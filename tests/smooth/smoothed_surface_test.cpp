#include "smooth/smoothed_surface.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "pdc/error.h"
#include "simplify/shapes.h"

namespace pdc::detail {
namespace {

using test::cube, test::plate;

TEST(SmoothedSurface, NeighboursAreTheTrianglesAcrossTheEdges) {
  const SmoothedSurface surface(cube(3));
  EXPECT_EQ(surface.faces(), 108u);
  EXPECT_TRUE(surface.walls().empty());
  for (std::uint32_t i = 0; i < surface.faces(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& own = surface.triangles()[i];
      const Triangle& other = surface.triangles()[surface.neighbours(i)[k]];
      const std::set<std::uint32_t> both(other.begin(), other.end());
      EXPECT_TRUE(both.contains(own[k]) && both.contains(own[(k + 1) % 3]));
      EXPECT_FALSE(both.contains(own[(k + 2) % 3]));
    }
}

TEST(SmoothedSurface, WallsStandAroundTheBoundaryInOrder) {
  const SmoothedSurface surface(plate(3));
  ASSERT_EQ(surface.walls().size(), 12u);
  std::uint32_t wall = 18;
  std::set<std::uint32_t> seen;
  do {
    seen.insert(wall);
    const std::uint32_t after = surface.neighbours(wall)[2];
    EXPECT_EQ(surface.walls()[wall - 18].to, surface.walls()[after - 18].from);
    EXPECT_EQ(surface.neighbours(after)[1], wall);
    const std::uint32_t from = surface.walls()[after - 18].from;
    EXPECT_EQ(surface.wallsAt(from), (std::array<std::uint32_t, 2>{wall, after}));
    wall = after;
  } while (wall != 18);
  EXPECT_EQ(seen.size(), 12u);
  EXPECT_FALSE(surface.atBoundary(5));
}

std::string complaint(const Mesh& mesh) {
  try {
    const SmoothedSurface surface(mesh);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SmoothedSurface, RefusesWhatIsNoManifold) {
  Mesh mesh = plate(2);
  mesh.positions.push_back({0.5F, 0.5F, 1});
  mesh.triangles.push_back({4, 5, 9});
  EXPECT_EQ(complaint(mesh),
            "the surface is no oriented manifold at 2 vertices, the first of which is 4; the limit is 0")
      << "three faces at an edge";

  mesh = plate(2);
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_NE(complaint(mesh).find("at 3 vertices"), std::string::npos) << "one face turned over";

  mesh = plate(1);
  mesh.positions.insert(mesh.positions.end(), {{2, 2, 0}, {2, 3, 0}});
  mesh.triangles.push_back({3, 4, 5});
  EXPECT_NE(complaint(mesh).find("at 1 vertices, the first of which is 3"), std::string::npos) << "two fans";

  EXPECT_NE(complaint({}).find("0 faces"), std::string::npos);
}

TEST(SmoothedSurface, DegenerateAndNonFiniteTrianglesAreLeftOut) {
  Mesh mesh = plate(2);
  mesh.triangles.push_back({0, 0, 1});
  mesh.positions.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
  mesh.triangles.push_back({0, 1, 9});
  EXPECT_EQ(SmoothedSurface(mesh).triangles().size(), 8u);
}

}  // namespace
}  // namespace pdc::detail
