#include "pdc/mesh/self_intersections.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "mesh/faces.h"
#include "pdc/error.h"

namespace pdc {
namespace {

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

Mesh makeMesh(std::initializer_list<Vec3f> positions, std::initializer_list<Triangle> triangles) {
  Mesh mesh;
  mesh.positions.assign(positions);
  mesh.triangles.assign(triangles);
  return mesh;
}

void append(Mesh& mesh, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

/// Quads around a torus of radii 2 and 0.5, each vertex moved by up to `noise` along each axis.
Mesh torus(std::uint32_t major, std::uint32_t minor, float noise) {
  std::mt19937 random(31);
  std::uniform_real_distribution<float> uniform(-noise, noise);
  Mesh mesh;
  for (std::uint32_t i = 0; i < major; ++i)
    for (std::uint32_t j = 0; j < minor; ++j) {
      const double u = 2 * std::numbers::pi * i / major, v = 2 * std::numbers::pi * j / minor;
      const double r = 2 + 0.5 * std::cos(v);
      mesh.positions.push_back(vecCast<float>(Vec3d{r * std::cos(u), r * std::sin(u), 0.5 * std::sin(v)}) +
                               Vec3f{uniform(random), uniform(random), uniform(random)});
      const auto at = [&](std::uint32_t a, std::uint32_t b) { return (a % major) * minor + b % minor; };
      mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// Every pair.
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

TEST(SelfIntersections, NoneInSoundMeshes) {
  for (const Mesh& mesh : {Mesh{}, torus(40, 20, 0)}) {
    const SelfIntersections result = selfIntersections(mesh);
    EXPECT_TRUE(result.pairs.empty());
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(result.degenerateTriangles + result.nonFiniteTriangles, 0u);
  }
}

TEST(SelfIntersections, Fixtures) {
  const Pairs one{{0, 1}};
  const Mesh foldAtEdge = makeMesh({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 0, 3}});
  EXPECT_EQ(selfIntersections(foldAtEdge).pairs, one);
  const Mesh foldAtVertex = makeMesh({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, -1}, {1, 1, 1}}, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_EQ(selfIntersections(foldAtVertex).pairs, one);
  const Mesh overlap =
      makeMesh({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 0.5f, 0}, {3, 0.5f, 0}, {1, 3, 0}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(selfIntersections(overlap).pairs, one);
  const Mesh touch =
      makeMesh({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, 0}, {3, 3, 1}, {3, 3, -1}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(selfIntersections(touch).pairs, one);
  const Mesh twice = makeMesh({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}, {1, 0, 2}, {1, 2, 0}});
  EXPECT_EQ(selfIntersections(twice).pairs, (Pairs{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(SelfIntersections, QuadsAreTwoTrianglesAndComeFirst) {
  // The second quad is a dart that folds over its own diagonal.
  Mesh mesh = makeMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 0, 0}, {9, 3, 0}, {8, 1, 0}, {8.5f, 1, 0}}, {});
  mesh.quads = {{0, 1, 2, 3}, {5, 6, 4, 7}};
  append(mesh, {0.7f, 0.2f, -1}, {0.7f, 0.2f, 1}, {0.8f, 0.2f, 1});
  append(mesh, {0.2f, 0.7f, -1}, {0.2f, 0.7f, 1}, {0.3f, 0.8f, 1});
  EXPECT_EQ(selfIntersections(mesh).pairs, (Pairs{{0, 4}, {1, 5}, {2, 3}}));
}

TEST(SelfIntersections, DegenerateAndNonFiniteTrianglesAreCountedAndLeftOut) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Mesh mesh;
  append(mesh, {0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  append(mesh, {0, 0, 0}, {1, 1, 0}, {2, 2, 0});
  append(mesh, {0, 0, 0}, {kNaN, 0, 0}, {0, 2, 0});
  append(mesh, {0, 0, 0}, {2, 0, -kInfinity}, {0, 2, 0});
  mesh.triangles.push_back({0, 1, 1});
  append(mesh, {1, 1, -1}, {1, 1, 1}, {5, 5, 0});
  const SelfIntersections result = selfIntersections(mesh);
  EXPECT_EQ(result.pairs, (Pairs{{0, 5}}));
  EXPECT_EQ(result.degenerateTriangles, 2u);
  EXPECT_EQ(result.nonFiniteTriangles, 2u);
}

TEST(SelfIntersections, FindsWhatTryingEveryPairFinds) {
  std::mt19937 random(32);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::size_t pairs = 0;
  for (int round = 0; round < 40; ++round) {
    // Sizes over ten orders of magnitude, some corners shared.
    Mesh mesh = torus(12, 8, round % 4 == 0 ? 0.0f : 0.15f);
    for (int i = 0; i < 40; ++i) {
      const Vec3f p{uniform(random), uniform(random), uniform(random)};
      const float size = std::pow(10.0f, 3 * uniform(random) - static_cast<float>(random() % 4));
      const auto corner = [&] { return p + Vec3f{uniform(random), uniform(random), uniform(random)} * size; };
      append(mesh, corner(), corner(), corner());
      if (random() % 2 == 0) mesh.triangles.back()[0] = static_cast<std::uint32_t>(random() % mesh.positions.size());
    }
    if (round % 4 == 1)  // Contacts at the borders of boxes.
      for (Vec3f& v : mesh.positions) v = {std::round(4 * v.x), std::round(4 * v.y), std::round(4 * v.z)};
    const Pairs expected = searchSlowly(mesh);
    ASSERT_EQ(selfIntersections(mesh).pairs, expected);
    pairs += expected.size();
  }
  EXPECT_GT(pairs, 1000u);
}

TEST(SelfIntersections, APartFarAwayDoesNotBlurTheRest) {
  Mesh mesh = torus(60, 30, 0.08f);
  const Pairs alone = selfIntersections(mesh).pairs;
  EXPECT_GT(alone.size(), 100u);
  append(mesh, {1e38f, 0, 0}, {1e38f, 1e20f, 0}, {1e38f, 0, 1e20f});
  append(mesh, {-3e38f, -3e38f, 0}, {3e38f, -3e38f, 5}, {0, 3e38f, 5});
  append(mesh, {1e-40f, 5, 0}, {0, 5, 1e-42f}, {0, 5 + 1e-6f, 0});
  EXPECT_EQ(selfIntersections(mesh).pairs, searchSlowly(mesh));
}

TEST(SelfIntersections, DoNotDependOnThreads) {
  const Mesh mesh = torus(300, 150, 0.02f);
  const Pairs all = selfIntersections(mesh).pairs, some = selfIntersections(mesh, {.maxPairs = 777}).pairs;
  EXPECT_GT(all.size(), 2000u);
  EXPECT_EQ(some.size(), 777u);
  for (const std::size_t threads : {1u, 2u, 8u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(selfIntersections(mesh).pairs, all);
    EXPECT_EQ(selfIntersections(mesh, {.maxPairs = 777}).pairs, some);
  }
}

TEST(SelfIntersections, EndWhenThereAreTooMany) {
  const Mesh few = torus(60, 30, 0.08f);
  const Pairs all = selfIntersections(few).pairs;
  EXPECT_TRUE(selfIntersections(few, {.maxPairs = all.size()}).complete);
  const SelfIntersections cut = selfIntersections(few, {.maxPairs = all.size() - 1});
  EXPECT_FALSE(cut.complete);
  EXPECT_EQ(cut.pairs.size(), all.size() - 1);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), cut.pairs.begin(), cut.pairs.end()));
  EXPECT_FALSE(selfIntersections(few, {.maxPairs = 0}).complete);

  // 5e9 pairs, which nobody could wait for.
  Mesh many = makeMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {});
  many.triangles.assign(100'000, {0, 1, 2});
  const SelfIntersections first = selfIntersections(many, {.maxPairs = 10'000});
  EXPECT_FALSE(first.complete);
  EXPECT_EQ(first.pairs.size(), 10'000u);
}

TEST(SelfIntersections, CanBeWatchedAndStopped) {
  const Mesh mesh = torus(200, 100, 0);
  std::atomic<double> last{0};
  std::atomic<bool> stop{false};
  const Monitor watch{.progress = [&](const char*, double share) { last = std::max(last.load(), share); },
                      .stop = &stop};
  (void)selfIntersections(mesh, {}, watch);
  EXPECT_EQ(last, 1.0);
  const Monitor ending{.progress = [&](const char*, double) { stop = true; }, .stop = &stop};
  EXPECT_THROW((void)selfIntersections(mesh, {}, ending), Cancelled);
  EXPECT_THROW((void)selfIntersections(mesh, {}, watch), Cancelled);
}

TEST(SelfIntersections, RefuseFacesWithoutVertices) {
  EXPECT_THROW((void)selfIntersections(makeMesh({{0, 0, 0}}, {{0, 0, 1}})), Error);
}

}  // namespace
}  // namespace pdc
