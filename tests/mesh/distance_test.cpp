#include "pdc/mesh/distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "pdc/error.h"
#include "render/shapes.h"

namespace pdc::test {
namespace {

double distance(const Vec3f& p, const Mesh& mesh) { return distances({&p, 1}, mesh)[0]; }

TEST(Distance, ToACube) {
  const Mesh mesh = cube();
  EXPECT_EQ(distance({0, 0, 0}, mesh), 1);
  EXPECT_EQ(distance({0.25F, 0.5F, -0.5F}, mesh), 0.5);
  EXPECT_EQ(distance({3, 0.5F, 0.25F}, mesh), 2);
  EXPECT_EQ(distance({4, 5, 0}, mesh), 5);
  EXPECT_DOUBLE_EQ(distance({2, 2, -2}, mesh), std::sqrt(3.0));
  EXPECT_EQ(distance({1, -1, 1}, mesh), 0);
}

TEST(Distance, HeedsTheOriginsOfBothMeshes) {
  Mesh here;
  here.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  here.triangles = {{0, 1, 2}};
  here.origin = {1e8, 0, 0};
  Mesh there = here;
  there.origin = {1e8, 0, 0.375};
  EXPECT_EQ(vertexDistances(here, there), (Buffer<double>{0.375, 0.375, 0.375}));
  EXPECT_EQ(distance({1e8F, 0, 0.5F}, there), 0.125) << "from a place in the world";
}

TEST(Distance, ToATriangleOfNoAreaIsThatToItsEdges) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {50, 50, 50}};
  mesh.triangles = {{0, 1, 2}, {3, 3, 3}};
  EXPECT_EQ(distance({1.5F, 3, 4}, mesh), 5);
  EXPECT_EQ(distance({50, 50, 51}, mesh), 1);
}

// Against one triangle at a time, for which there is nothing to search.
TEST(Distance, IsTheLeastOverAllTriangles) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> number(-1, 1);
  const auto point = [&] { return Vec3f{number(random), number(random), number(random)}; };
  Mesh mesh;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Vec3f p = point();
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(p + point() * (i % 10 == 0 ? 1.0F : 0.1F));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  std::vector<Vec3f> points(300);
  std::generate(points.begin(), points.end(), [&] { return point() * 2; });
  std::vector<double> least(points.size(), std::numeric_limits<double>::infinity());
  for (const Triangle& t : mesh.triangles) {
    Mesh alone;
    alone.positions = mesh.positions;
    alone.triangles = {t};
    const auto d = distances(points, alone);
    for (std::size_t i = 0; i < points.size(); ++i) least[i] = std::min(least[i], d[i]);
  }
  const auto all = distances(points, mesh);
  EXPECT_TRUE(std::equal(least.begin(), least.end(), all.begin()));
}

TEST(Distance, WhatIsNotFinite) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  Mesh mesh = cube();
  mesh.positions.push_back({kNan, 0, 0});
  mesh.triangles.push_back({0, 1, 8});
  EXPECT_EQ(distance({0, 0, 0}, mesh), 1);
  EXPECT_TRUE(std::isnan(distance({0, kNan, 0}, mesh)));
  mesh.quads.clear();
  EXPECT_THROW(static_cast<void>(distance({0, 0, 0}, mesh)), Error);
  EXPECT_THROW(static_cast<void>(distance({0, 0, 0}, Mesh{})), Error);
}

}  // namespace
}  // namespace pdc::test
