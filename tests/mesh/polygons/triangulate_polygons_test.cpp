#include "pdc/mesh/triangulate_polygons.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace pdc {
namespace {

TEST(TriangulatePolygons, FansComeAfterTheTrianglesInOrder) {
  Mesh mesh;
  mesh.positions.assign(7, Vec3f{1, 2, 3});
  mesh.quads = {{0, 1, 2, 3}};
  mesh.triangles = {{4, 5, 6}};
  mesh.polygons = {.corners = {0, 1, 2, 3, 4, /**/ 6, 5, 4, /**/ 3, 2, 1, 0}, .starts = {0, 5, 8}};
  triangulatePolygons(mesh);
  EXPECT_EQ(mesh.triangles,
            (Buffer<Triangle>{{4, 5, 6}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {6, 5, 4}, {3, 2, 1}, {3, 1, 0}}));
  EXPECT_TRUE(mesh.polygons.empty());
  EXPECT_TRUE(mesh.polygons.corners.empty());
  EXPECT_EQ(mesh.quads.size(), 1u);
  EXPECT_EQ(mesh.positions.size(), 7u);
}

TEST(TriangulatePolygons, WithoutPolygonsNothingChanges) {
  Mesh mesh;
  mesh.triangles = {{0, 1, 2}};
  triangulatePolygons(mesh);
  EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}}));
}

TEST(TriangulatePolygons, StartsThatDoNotFitAreRefused) {
  for (const Buffer<std::size_t>& starts :
       {Buffer<std::size_t>{}, Buffer<std::size_t>{1}, Buffer<std::size_t>{0, 2}, Buffer<std::size_t>{0, 6},
        Buffer<std::size_t>{0, 4}, Buffer<std::size_t>{0, 7}, Buffer<std::size_t>{0, 3, 0}}) {
    Mesh mesh;
    mesh.polygons = {.corners = {0, 1, 2, 3, 4, 5}, .starts = starts};
    EXPECT_THROW(triangulatePolygons(mesh), std::invalid_argument) << testing::PrintToString(starts);
  }
}

}  // namespace
}  // namespace pdc
