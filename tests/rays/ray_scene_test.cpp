#include "rays/ray_scene.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace pdc::detail {
namespace {

/// Triangles with the spare position that RayScene asks for.
struct Soup {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;

  void add(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
  }
  [[nodiscard]] std::array<Vec3d, 3> corners(std::size_t i) const {
    const Triangle& t = triangles[i];
    return {vecCast<double>(positions[t[0]]), vecCast<double>(positions[t[1]]), vecCast<double>(positions[t[2]])};
  }
  /// The soup must stay as it is while the scene lives.
  RayScene scene() {
    positions.push_back({});
    return RayScene(positions, triangles);
  }
};

struct Ray {
  Vec3f origin, direction;

  [[nodiscard]] Vec3d at(double distance) const {
    return vecCast<double>(origin) + vecCast<double>(direction) * distance;
  }
};

/// Where a ray meets a triangle's plane.
struct PlaneHit {
  double distance, u, v;

  /// The smallest of the distances from the triangle's edges, as barycentric weights; negative outside.
  [[nodiscard]] double depth() const { return std::min({u, v, 1 - u - v}); }
};

/// Möller & Trumbore 1997, in double precision; nothing if the ray is parallel to the plane.
std::optional<PlaneHit> meet(const Ray& ray, const std::array<Vec3d, 3>& corners) {
  const Vec3d direction = vecCast<double>(ray.direction), from = vecCast<double>(ray.origin) - corners[0];
  const Vec3d e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
  const Vec3d p = cross(direction, e2), q = cross(from, e1);
  const double determinant = dot(e1, p);
  if (determinant == 0) return std::nullopt;
  return PlaneHit{dot(e2, q) / determinant, dot(from, p) / determinant, dot(direction, q) / determinant};
}

/// Single precision may decide otherwise than double precision within this distance of an edge or a triangle.
constexpr double kTolerance = 1e-3;

/// What a ray meets first by testing all triangles, and whether single precision could see it otherwise.
struct Expected {
  std::optional<std::size_t> triangle;
  PlaneHit hit{std::numeric_limits<double>::infinity(), 0, 0};
  bool close = false;
};

Expected firstOf(const Soup& soup, const Ray& ray) {
  Expected first;
  std::vector<double> distances;
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    const auto hit = meet(ray, soup.corners(i));
    if (!hit || hit->distance < -kTolerance || hit->depth() < -kTolerance) continue;
    first.close = first.close || hit->depth() < kTolerance || hit->distance < kTolerance;
    distances.push_back(hit->distance);
    if (hit->depth() < 0 || hit->distance < 0 || hit->distance >= first.hit.distance) continue;
    first.triangle = i;
    first.hit = *hit;
  }
  for (const double d : distances)
    if (d != first.hit.distance && std::abs(d - first.hit.distance) < kTolerance) first.close = true;
  return first;
}

class RandomRays {
 public:
  explicit RandomRays(unsigned seed) : mEngine(seed) {}

  Vec3f point(float reach) { return {uniform(reach), uniform(reach), uniform(reach)}; }
  Ray ray() {
    const Vec3f origin = point(2);
    return {origin, point(2) - origin};
  }
  Soup soup(std::size_t count) {
    Soup soup;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3f middle = point(1);
      soup.add(middle + point(0.5F), middle + point(0.5F), middle + point(0.5F));
    }
    return soup;
  }

 private:
  float uniform(float reach) { return std::uniform_real_distribution<float>(-reach, reach)(mEngine); }

  std::mt19937 mEngine;
};

TEST(RayScene, FindsTheFirstOfManyTriangles) {
  RandomRays random(1);
  Soup soup = random.soup(60);
  const RayScene scene = soup.scene();
  int hits = 0, misses = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Ray ray = random.ray();
    const Expected expected = firstOf(soup, ray);
    if (expected.close) continue;
    const RayHit hit = scene.hit(ray.origin, ray.direction);
    ASSERT_EQ(hit.found, expected.triangle.has_value());
    if (!hit.found) {
      ++misses;
      continue;
    }
    ++hits;
    ASSERT_EQ(hit.triangle, *expected.triangle);
    ASSERT_NEAR(hit.distance, expected.hit.distance, 1e-4 * (1 + expected.hit.distance));
    ASSERT_NEAR(hit.u, expected.hit.u, kTolerance);
    ASSERT_NEAR(hit.v, expected.hit.v, kTolerance);
  }
  EXPECT_GT(hits, 3000);
  EXPECT_GT(misses, 3000);
}

TEST(RayScene, WeightsGiveThePointThatIsMet) {
  RandomRays random(2);
  Soup soup = random.soup(60);
  const RayScene scene = soup.scene();
  int hits = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Ray ray = random.ray();
    const RayHit hit = scene.hit(ray.origin, ray.direction);
    if (!hit.found) continue;
    ++hits;
    ASSERT_GE(hit.distance, 0);
    ASSERT_GE(hit.u, -1e-6F);
    ASSERT_GE(hit.v, -1e-6F);
    ASSERT_LE(hit.u + hit.v, 1 + 1e-6F);
    const auto [a, b, c] = soup.corners(hit.triangle);
    const Vec3d met = a * (1.0 - hit.u - hit.v) + b * double{hit.u} + c * double{hit.v};
    ASSERT_LT(length(met - ray.at(hit.distance)), kTolerance * (1 + hit.distance));
  }
  EXPECT_GT(hits, 3000);
}

TEST(RayScene, IsBlockedByWhatIsNearerThanTheReach) {
  RandomRays random(3);
  Soup soup = random.soup(60);
  const RayScene scene = soup.scene();
  int blocked = 0, free = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Ray ray = random.ray();
    const Expected expected = firstOf(soup, ray);
    if (expected.close) continue;
    if (!expected.triangle) {
      ++free;
      ASSERT_FALSE(scene.blocked(ray.origin, ray.direction, std::numeric_limits<float>::infinity()));
      continue;
    }
    ++blocked;
    const auto distance = static_cast<float>(expected.hit.distance);
    ASSERT_TRUE(scene.blocked(ray.origin, ray.direction, std::numeric_limits<float>::infinity()));
    ASSERT_TRUE(scene.blocked(ray.origin, ray.direction, distance * 1.01F));
    ASSERT_FALSE(scene.blocked(ray.origin, ray.direction, distance * 0.99F));
  }
  EXPECT_GT(blocked, 3000);
  EXPECT_GT(free, 3000);
}

TEST(RayScene, DistancesCountLengthsOfTheDirection) {
  Soup soup;
  soup.add({-1, -1, 3}, {1, -1, 3}, {0, 1, 3});
  const RayScene scene = soup.scene();
  EXPECT_EQ(scene.hit({0, 0, 0}, {0, 0, 1}).distance, 3);
  EXPECT_EQ(scene.hit({0, 0, 0}, {0, 0, 2}).distance, 1.5F);
  EXPECT_TRUE(scene.blocked({0, 0, 0}, {0, 0, 2}, 2));
  EXPECT_FALSE(scene.blocked({0, 0, 0}, {0, 0, 2}, 1));
}

TEST(RayScene, MeetsBothFacesOfATriangleAndNothingBehindTheOrigin) {
  Soup soup;
  soup.add({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  const RayScene scene = soup.scene();
  EXPECT_TRUE(scene.hit({0, 0, 1}, {0, 0, -1}).found);
  EXPECT_TRUE(scene.hit({0, 0, -1}, {0, 0, 1}).found);
  EXPECT_FALSE(scene.hit({0, 0, 1}, {0, 0, 1}).found);
  EXPECT_FALSE(scene.blocked({0, 0, 1}, {0, 0, 1}, 10));
}

TEST(RayScene, MeetsNothingWhereThereIsNothing) {
  Soup soup;
  const RayScene scene = soup.scene();
  EXPECT_FALSE(scene.hit({0, 0, 1}, {0, 0, -1}).found);
  EXPECT_FALSE(scene.blocked({0, 0, 1}, {0, 0, -1}, 10));
}

/// A square of n × n cells, each cut along a diagonal, slightly uneven so that no edge lies on a lattice of rays.
Soup unevenSheet(int n) {
  Soup soup;
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(-0.2F, 0.2F);
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      soup.positions.push_back(
          {static_cast<float>(x) + uniform(random), static_cast<float>(y) + uniform(random), uniform(random)});
  const auto vertex = [n](int x, int y) { return static_cast<std::uint32_t>(x + y * (n + 1)); };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      soup.triangles.push_back({vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1)});
      soup.triangles.push_back({vertex(x, y), vertex(x + 1, y + 1), vertex(x, y + 1)});
    }
  return soup;
}

TEST(RayScene, NoRaySlipsThroughBetweenTriangles) {
  constexpr int kCells = 20;
  Soup soup = unevenSheet(kCells);
  const std::vector<Vec3f> vertices = soup.positions;
  const RayScene scene = soup.scene();
  RandomRays random(5);
  const auto inner = [](const Vec3f& p) { return p.x > 1 && p.y > 1 && p.x < kCells - 1 && p.y < kCells - 1; };
  int aimed = 0;
  for (const Triangle& t : soup.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3f a = vertices[t[k]], b = vertices[t[(k + 1) % 3]];
      for (const float share : {0.0F, 0.1F, 0.37F, 0.5F}) {
        const Vec3f target = a + (b - a) * share;
        if (!inner(target)) continue;
        ++aimed;
        const Vec3f origin = target + random.point(0.5F) + Vec3f{0, 0, 5};
        ASSERT_TRUE(scene.hit(origin, target - origin).found);
        ASSERT_TRUE(scene.blocked(origin, target - origin, 2));
      }
    }
  EXPECT_GT(aimed, 5000);
}

TEST(RayScene, AnswersAreTheSameFromAnyThread) {
  RandomRays random(6);
  Soup soup = random.soup(200);
  const RayScene scene = soup.scene();
  std::vector<Ray> rays(5000);
  for (Ray& ray : rays) ray = random.ray();
  std::vector<RayHit> serial(rays.size()), parallel(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) serial[i] = scene.hit(rays[i].origin, rays[i].direction);
  tbb::parallel_for(std::size_t{0}, rays.size(),
                    [&](std::size_t i) { parallel[i] = scene.hit(rays[i].origin, rays[i].direction); });
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(serial[i].found, parallel[i].found);
    ASSERT_EQ(serial[i].triangle, parallel[i].triangle);
    ASSERT_EQ(serial[i].distance, parallel[i].distance);
  }
}

}  // namespace
}  // namespace pdc::detail
