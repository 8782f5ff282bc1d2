#include "mesh/hubs.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

namespace pdc::detail {
namespace {

TEST(Hubs, AreTheVerticesWithManyTriangles) {
  // 100 triangles about vertex 0, 70 about vertex 1, and one with both.
  Mesh mesh;
  mesh.positions.resize(500, Vec3f{});
  for (std::uint32_t k = 0; k < 100; ++k) mesh.triangles.push_back({2 + k, 0, 3 + k});
  for (std::uint32_t k = 0; k < 70; ++k) mesh.triangles.push_back({200 + k, 201 + k, 1});
  mesh.triangles.push_back({0, 1, 400});
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  const auto always = [](std::uint32_t, std::uint32_t) { return true; };
  HubSearch search(mesh);
  for (int twice = 0; twice < 2; ++twice) {
    const Hubs hubs = search.run(all, kNoHub, always);
    EXPECT_EQ(hubs.vertices, (std::vector<std::uint32_t>{0, 1}));
    ASSERT_EQ(hubs.triangles.size(), 2u);
    EXPECT_EQ(hubs.triangles[0].size(), 101u);
    EXPECT_EQ(hubs.triangles[1].size(), 70u);
    EXPECT_EQ(hubs.of[170], 0u) << "the larger of two";
  }
  EXPECT_EQ(search.run(all, 0, always).vertices, std::vector<std::uint32_t>{1});
  const std::vector<std::uint32_t> few(all.begin(), all.begin() + 63);
  EXPECT_TRUE(search.run(few, kNoHub, always).of.empty());
  const Hubs fitting = search.run(all, kNoHub, [](std::uint32_t t, std::uint32_t) { return t != 5; });
  EXPECT_EQ(fitting.of[5], kNoHub);
}

}  // namespace
}  // namespace pdc::detail
