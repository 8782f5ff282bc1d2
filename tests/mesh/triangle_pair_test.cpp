#include "mesh/triangle_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "pdc/math/predicates.h"

namespace pdc::detail {
namespace {

using Number = boost::multiprecision::cpp_rational;
using Point = std::array<Number, 3>;
using Polygon = std::vector<Point>;

struct Pair {
  TriangleCorners a{}, b{};
  Triangle aVertices{0, 1, 2}, bVertices{3, 4, 5};

  [[nodiscard]] bool intersects() const { return trianglesIntersect(a, aVertices, b, bVertices); }
};

/// b's first corners are the last ones of a.
Pair sharing(std::uint32_t shared, const TriangleCorners& a, TriangleCorners b) {
  Pair pair{.a = a, .b = b};
  for (std::uint32_t i = 0; i < shared; ++i) {
    pair.b[i] = a[2 - i];
    pair.bVertices[i] = 2 - i;
  }
  return pair;
}

const TriangleCorners kBase{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

Pair apart(const TriangleCorners& b) { return {.a = kBase, .b = b}; }
/// The other triangle has the corner (0, 4, 0) too.
Pair atVertex(const Vec3f& p, const Vec3f& q) { return sharing(1, kBase, {{{}, p, q}}); }
/// The other triangle has the edge from (4, 0, 0) to (0, 4, 0) too.
Pair atEdge(const Vec3f& p) { return sharing(2, kBase, {{{}, {}, p}}); }

TEST(TrianglePair, WithoutSharedCorner) {
  EXPECT_TRUE(apart({{{1, 1, -1}, {1, 1, 1}, {9, 9, 1}}}).intersects()) << "pierced";
  EXPECT_TRUE(apart({{{1, -1, -1}, {1, -1, 1}, {1, 9, 0}}}).intersects()) << "crossed by a blade";
  EXPECT_FALSE(apart({{{1, 1, 1}, {1, 1, 2}, {9, 9, 1}}}).intersects()) << "above";
  EXPECT_FALSE(apart({{{3, 3, -1}, {3, 3, 1}, {9, 9, 1}}}).intersects()) << "crosses the plane beside it";
  EXPECT_FALSE(apart({{{3, 2, -1}, {3, 2, 1}, {2, 3, 0}}}).intersects()) << "beside the long edge";
}

TEST(TrianglePair, TouchCounts) {
  EXPECT_TRUE(apart({{{1, 1, 0}, {1, 1, 1}, {9, 9, 1}}}).intersects()) << "corner on the face";
  EXPECT_TRUE(apart({{{2, 2, 0}, {3, 3, 1}, {3, 3, -1}}}).intersects()) << "corner on an edge";
  EXPECT_TRUE(apart({{{2, 2, 1}, {2, 2, -1}, {3, 3, 0}}}).intersects()) << "edge on an edge";
  EXPECT_TRUE(apart({{{4, 0, 0}, {5, 0, 1}, {5, 0, -1}}}).intersects()) << "corner on a corner";
  EXPECT_TRUE(apart({{{1, 1, 0}, {2, 1, 0}, {1, 1, 5}}}).intersects()) << "edge in the face";
  EXPECT_TRUE(apart({{{4, 0, 0}, {4, -4, 0}, {8, 0, 0}}}).intersects()) << "corner on a corner in one plane";
  const float below = std::nextafter(2.0f, 0.0f), above = std::nextafter(2.0f, 9.0f);
  EXPECT_TRUE(apart({{{2, below, 0}, {3, 3, 1}, {3, 3, -1}}}).intersects());
  EXPECT_FALSE(apart({{{2, above, 0}, {3, 3, 1}, {3, 3, -1}}}).intersects()) << "one rounding apart";
}

TEST(TrianglePair, InOnePlane) {
  EXPECT_TRUE(apart({{{1, 1, 0}, {9, 1, 0}, {9, 9, 0}}}).intersects()) << "overlap";
  EXPECT_TRUE(apart({{{1, 1, 0}, {1.5f, 1, 0}, {1, 1.5f, 0}}}).intersects()) << "one within the other";
  EXPECT_TRUE(apart({{{-9, -9, 0}, {99, -9, 0}, {-9, 99, 0}}}).intersects()) << "one around the other";
  EXPECT_TRUE(apart({{{1, -1, 0}, {2, -1, 0}, {1, 9, 0}}}).intersects()) << "a cross without corners inside";
  EXPECT_FALSE(apart({{{3, 3, 0}, {9, 3, 0}, {9, 9, 0}}}).intersects()) << "beside";
}

TEST(TrianglePair, SharedCorner) {
  EXPECT_FALSE(atVertex({0, 8, 1}, {1, 8, 0}).intersects());
  EXPECT_FALSE(atVertex({-1, 0, 1}, {-1, 0, -1}).intersects()) << "the blade passes beside";
  EXPECT_TRUE(atVertex({1, 0, 1}, {1, 0, -1}).intersects()) << "the blade ends on an edge";
  EXPECT_TRUE(atVertex({1, 1, 1}, {1, 1, -1}).intersects()) << "its edge pierces";
  EXPECT_TRUE(atVertex({1, -9, 1}, {1, -9, -1}).intersects()) << "it is pierced";
  EXPECT_TRUE(atVertex({0, 0, 0}, {0, 0, 5}).intersects()) << "another vertex in the same place";
  EXPECT_TRUE(atVertex({1, 1, 0}, {1, 1, 5}).intersects()) << "touch";
  EXPECT_TRUE(atVertex({1, 1, 0}, {2, 1, 0}).intersects()) << "fold in one plane";
  EXPECT_FALSE(atVertex({-1, 4, 0}, {-1, 0, 0}).intersects()) << "beside in one plane";
  EXPECT_TRUE(atVertex({0, 1, 0}, {-1, 0, 0}).intersects()) << "along an edge in one plane";
}

TEST(TrianglePair, SharedEdge) {
  EXPECT_FALSE(atEdge({4, 4, 0}).intersects()) << "flat";
  EXPECT_FALSE(atEdge({0, 0, 1}).intersects()) << "sharp";
  EXPECT_FALSE(atEdge({0, 0, 1e-30f}).intersects()) << "as sharp as can be";
  EXPECT_TRUE(atEdge({1, 1, 0}).intersects()) << "folded over";
  EXPECT_TRUE(atEdge({-9, 5, 0}).intersects()) << "folded over, neither within the other";
  EXPECT_TRUE(sharing(3, kBase, kBase).intersects()) << "the same face again";
}

TEST(TrianglePair, Degenerate) {
  EXPECT_FALSE(isDegenerate(kBase));
  EXPECT_TRUE(isDegenerate({{{1, 2, 3}, {2, 4, 6}, {3, 6, 9}}}));
  EXPECT_TRUE(isDegenerate({{{1, 2, 3}, {1, 2, 3}, {3, 6, 0}}}));
  EXPECT_FALSE(isDegenerate({{{0, 0, 0}, {1, 0, 1e-38f}, {2, 0, 1e-38f}}}));
}

// --- the definition taken literally: clip one triangle by the other and see whether anything is left off the shared
// part

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Number dotProduct(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point crossProduct(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
const Point kZero{0, 0, 0};

/// The part where dot(normal, p - origin) >= 0.
Polygon clipped(const Polygon& polygon, const Point& origin, const Point& normal) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Number hp = dotProduct(normal, p - origin), hq = dotProduct(normal, q - origin);
    if (hp >= 0) result.push_back(p);
    if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) {
      const Number t = hp / (hp - hq);
      const Point d = q - p;
      result.push_back({p[0] + d[0] * t, p[1] + d[1] * t, p[2] + d[2] * t});
    }
  }
  return result;
}

Polygon exactly(const TriangleCorners& t) {
  Polygon result;
  for (const Vec3f& p : t) result.push_back({Number(p.x), Number(p.y), Number(p.z)});
  return result;
}

Polygon intersection(const TriangleCorners& a, const TriangleCorners& b) {
  const Polygon t = exactly(b);
  const Point normal = crossProduct(t[1] - t[0], t[2] - t[0]);
  Polygon rest = clipped(clipped(exactly(a), t[0], normal), t[0], kZero - normal);
  for (std::size_t i = 0; i < 3; ++i) rest = clipped(rest, t[i], crossProduct(normal, t[(i + 1) % 3] - t[i]));
  return rest;
}

bool intersectsByDefinition(const Pair& pair) {
  const Polygon common = intersection(pair.a, pair.b), a = exactly(pair.a);
  Polygon shared;
  for (std::size_t i = 0; i < 3; ++i)
    if (std::count(pair.bVertices.begin(), pair.bVertices.end(), pair.aVertices[i]) > 0) shared.push_back(a[i]);
  if (shared.empty()) return !common.empty();
  if (shared.size() == 3) return true;
  return std::any_of(common.begin(), common.end(), [&](const Point& p) {
    if (shared.size() == 1) return p != shared[0];
    return crossProduct(p - shared[0], shared[1] - shared[0]) != kZero;
  });
}

/// Corners on a small lattice, where all kinds of contact are frequent.
Pair randomPair(std::mt19937& random, int size) {
  const auto point = [&] {
    std::uniform_int_distribution<int> coordinate(0, size);
    const auto number = [&] { return static_cast<float>(coordinate(random)); };
    return Vec3f{number(), number(), number()};
  };
  Pair pair;
  do {
    pair = sharing(random() % 4, {{point(), point(), point()}}, {{point(), point(), point()}});
    if (random() % 4 == 0)
      for (int i = 0; i < 3; ++i) pair.a[i].z = pair.b[i].z = 1;
    if (random() % 2 == 0) {
      const int i = static_cast<int>(random() % 3), j = static_cast<int>(random() % 3);
      std::swap(pair.b[i], pair.b[j]);
      std::swap(pair.bVertices[i], pair.bVertices[j]);
    }
  } while (isDegenerate(pair.a) || isDegenerate(pair.b));
  return pair;
}

TEST(TrianglePair, AgreesWithTheDefinition) {
  std::mt19937 random(11);
  std::array<std::array<int, 2>, 4> seen{};
  for (int round = 0; round < 12000; ++round) {
    const Pair pair = randomPair(random, 2 + round % 4);
    const bool expected = intersectsByDefinition(pair);
    ASSERT_EQ(pair.intersects(), expected) << "round " << round;
    const auto shared = std::count_if(pair.bVertices.begin(), pair.bVertices.end(), [](auto v) { return v < 3; });
    ++seen[static_cast<std::size_t>(shared)][expected ? 1 : 0];
  }
  for (std::size_t shared = 0; shared < 4; ++shared) {
    EXPECT_GT(seen[shared][1], 200) << shared;
    EXPECT_GT(seen[shared][0], shared < 3 ? 200 : -1) << shared;
  }
}

TEST(TrianglePair, KnownSidesChangeNothing) {
  std::mt19937 random(13);
  for (int round = 0; round < 12000; ++round) {
    const Pair pair = randomPair(random, 2 + round % 4);
    TriangleSides known;
    for (int i = 0; i < 3; ++i) {
      if (random() % 2 == 0) known.a[i] = orient3d(pair.b[0], pair.b[1], pair.b[2], pair.a[i]);
      if (random() % 2 == 0) known.b[i] = orient3d(pair.a[0], pair.a[1], pair.a[2], pair.b[i]);
    }
    ASSERT_EQ(trianglesIntersect(pair.a, pair.aVertices, pair.b, pair.bVertices, known), pair.intersects())
        << "round " << round;
  }
}

TEST(TrianglePair, DoesNotDependOnTheOrder) {
  std::mt19937 random(12);
  for (int round = 0; round < 3000; ++round) {
    const Pair pair = randomPair(random, 3);
    const bool expected = pair.intersects();
    std::array<int, 3> i{0, 1, 2}, j{0, 1, 2};
    do {
      do {
        Pair other;
        for (int k = 0; k < 3; ++k) {
          other.a[k] = pair.b[i[k]], other.aVertices[k] = pair.bVertices[i[k]];
          other.b[k] = pair.a[j[k]], other.bVertices[k] = pair.aVertices[j[k]];
        }
        ASSERT_EQ(other.intersects(), expected) << "round " << round;
      } while (std::next_permutation(j.begin(), j.end()));
    } while (std::next_permutation(i.begin(), i.end()));
  }
}

}  // namespace
}  // namespace pdc::detail
