// Meshes with many triangles at a vertex or an edge, and with slivers.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "mesh/faces.h"
#include "pdc/mesh/self_intersections.h"

namespace pdc {
namespace {

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

std::uint32_t add(Mesh& mesh, const Vec3d& p) {
  mesh.positions.push_back(vecCast<float>(p));
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

Vec3d onCircle(std::uint32_t k, std::uint32_t n) {
  const double u = 2 * std::numbers::pi * k / n;
  // Not in a plane of the axes.
  return Vec3d{0.6, 0.8, 0} * std::cos(u) + Vec3d{-0.48, 0.36, 0.8} * std::sin(u);
}
const Vec3d kAxis{0.64, -0.48, 0.6};

enum class Cap { kAroundCenter, kAroundCorner, kZigzag };

/// A prism over n points of a circle, its caps divided into triangles in one of three ways.
Mesh prism(std::uint32_t n, Cap cap) {
  Mesh mesh;
  for (const double height : {0.0, 1.0})
    for (std::uint32_t k = 0; k < n; ++k) add(mesh, onCircle(k, n) + kAxis * height);
  const auto addToCaps = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({n + a, n + b, n + c});
  };
  for (std::uint32_t k = 0; k < n; ++k) mesh.quads.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
  if (cap == Cap::kAroundCorner)
    for (std::uint32_t k = 1; k + 1 < n; ++k) addToCaps(0, k, k + 1);
  if (cap == Cap::kZigzag)
    for (std::uint32_t lo = 0, hi = n - 1; hi - lo > 1;) {
      addToCaps(lo, lo + 1, hi);
      if (++lo; hi - lo > 1) addToCaps(lo, hi - 1, hi), --hi;
    }
  if (cap != Cap::kAroundCenter) return mesh;
  const std::uint32_t bottom = add(mesh, {}), top = add(mesh, kAxis);
  for (std::uint32_t k = 0; k < n; ++k) {
    mesh.triangles.push_back({bottom, (k + 1) % n, k});
    mesh.triangles.push_back({top, n + k, n + (k + 1) % n});
  }
  return mesh;
}

/// n triangles with the edge 0 1 in common.
Mesh book(std::uint32_t n) {
  Mesh mesh;
  add(mesh, {});
  add(mesh, kAxis);
  for (std::uint32_t k = 0; k < n; ++k)
    mesh.triangles.push_back({0, 1, add(mesh, onCircle(k, n) + kAxis * (k % 7 - 3.0))});
  return mesh;
}

Pairs searchSlowly(const Mesh& mesh) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < detail::triangleCount(mesh); ++i)
    for (std::uint32_t j = i + 1; j < detail::triangleCount(mesh); ++j) {
      const Triangle a = detail::triangle(mesh, i), b = detail::triangle(mesh, j);
      const auto ac = detail::corners(mesh, a), bc = detail::corners(mesh, b);
      if (detail::isDegenerate(ac) || detail::isDegenerate(bc)) continue;
      if (detail::trianglesIntersect(ac, a, bc, b)) pairs.push_back({i, j});
    }
  return pairs;
}

TEST(SelfIntersectionsAtHubs, FindWhatTryingEveryPairFinds) {
  std::mt19937 random(33);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto anywhere = [&] { return Vec3d{uniform(random), uniform(random), uniform(random)}; };
  std::size_t pairs = 0;
  for (int round = 0; round < 60; ++round) {
    // Triangles about the vertices 0 and 1, some of them at the edge between these, the others anywhere.
    Mesh mesh;
    for (int k = 0; k < 2; ++k) add(mesh, anywhere());
    const double width = std::pow(10.0, -random() % 4);
    for (int i = 0; i < 300; ++i) {
      const Vec3d p = anywhere(), q = p + anywhere() * width;
      const std::uint32_t first = i % 3 == 0 ? add(mesh, anywhere()) : i % 2;
      const std::uint32_t second = i % 5 == 0 ? 1 - i % 2 : add(mesh, p);
      if (first != second) mesh.triangles.push_back({first, second, add(mesh, q)});
    }
    if (round % 3 == 1)  // Coplanar ones, and equal directions.
      for (Vec3f& v : mesh.positions) v = {std::round(3 * v.x), std::round(3 * v.y), std::round(3 * v.z)};
    if (round % 3 == 2)
      for (Vec3f& v : mesh.positions) v.z = 0;
    const Pairs expected = searchSlowly(mesh);
    ASSERT_EQ(selfIntersections(mesh).pairs, expected);
    pairs += expected.size();
  }
  EXPECT_GT(pairs, 10'000u);
}

TEST(SelfIntersectionsAtHubs, NoneBetweenTrianglesThatOnlyTouchAtTheHub) {
  for (const Cap cap : {Cap::kAroundCenter, Cap::kAroundCorner, Cap::kZigzag}) {
    const Mesh mesh = prism(500, cap);
    EXPECT_EQ(selfIntersections(mesh).pairs, searchSlowly(mesh));
    EXPECT_TRUE(selfIntersections(mesh).pairs.empty());
  }
  EXPECT_TRUE(selfIntersections(book(500)).pairs.empty());
}

TEST(SelfIntersectionsAtHubs, FindPagesThatFallTogether) {
  Mesh mesh = book(500);
  mesh.triangles.push_back({1, 0, add(mesh, vecCast<double>(mesh.positions[102]) * 2.0)});
  EXPECT_EQ(selfIntersections(mesh).pairs, (Pairs{{100, 500}}));
}

// Trying all pairs would take minutes.
TEST(SelfIntersectionsAtHubs, AreFoundInTimeAmongManyTriangles) {
  EXPECT_TRUE(selfIntersections(prism(40'000, Cap::kAroundCenter)).pairs.empty());
  EXPECT_TRUE(selfIntersections(book(100'000)).pairs.empty());
  Mesh sliced = prism(20'000, Cap::kZigzag);
  EXPECT_LT(selfIntersections(sliced).pairs.size(), 10u);
}

}  // namespace
}  // namespace pdc
