#include "mesh/components.h"

#include <gtest/gtest.h>

namespace pdc::detail {
namespace {

TEST(ComponentSizes, PiecesShareNoVertex) {
  Mesh mesh;
  mesh.positions.resize(13);
  mesh.quads = Buffer<Quad>(2);
  mesh.quads[0] = {5, 6, 1, 0};
  mesh.quads[1] = {7, 8, 5, 9};
  mesh.triangles = Buffer<Triangle>(1);
  mesh.triangles[0] = {10, 4, 3};
  EXPECT_EQ(componentSizes(mesh), (std::vector<std::uint32_t>{7, 1, 3, 1, 1}));
  EXPECT_TRUE(componentSizes({}).empty());
}

}  // namespace
}  // namespace pdc::detail
