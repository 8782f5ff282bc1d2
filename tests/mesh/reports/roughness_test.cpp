#include "pdc/mesh/roughness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/shapes.h"

namespace pdc::test {
namespace {

/// A square of n × n unit quads in the plane z = 0 with its ring of outer vertices.
Mesh plate(std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t i = y * (n + 1) + x;
      mesh.quads.push_back({i, i + 1, i + n + 2, i + n + 1});
    }
  return mesh;
}

TEST(Roughness, OfOneRaisedVertex) {
  Mesh mesh = plate(4);
  std::vector<std::uint8_t> chosen(mesh.positions.size(), 0);
  chosen[12] = 1;
  EXPECT_EQ(roughness(mesh, chosen), 0);
  mesh.positions[12].z = 0.25F;
  EXPECT_NEAR(roughness(mesh, chosen), 0.25, 1e-6);
  // One raised, one flat and two of whose four neighbours one is raised.
  chosen[6] = 1;
  EXPECT_NEAR(roughness(mesh, chosen), 0.25 / std::sqrt(2), 0.01);
  EXPECT_EQ(roughness(mesh, {}), 0);
}

TEST(FlatVertices, AreThoseWithoutACrease) {
  Mesh mesh = plate(4);
  for (Vec3f& p : mesh.positions)
    if (p.x > 2) p.z = p.x - 2;
  const auto flat = flatVertices(mesh, 15);
  for (std::size_t i = 0; i < flat.size(); ++i) EXPECT_EQ(flat[i], mesh.positions[i].x != 2) << i;
  const auto all = flatVertices(mesh, 35);
  EXPECT_EQ(std::count(all.begin(), all.end(), 1), 25);
  mesh.positions.push_back({9, 9, 9});
  EXPECT_EQ(flatVertices(mesh, 35).back(), 0);
  for (const auto corner : flatVertices(cube(), 15)) EXPECT_EQ(corner, 0);
}

}  // namespace
}  // namespace pdc::test
