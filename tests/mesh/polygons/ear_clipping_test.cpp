#include "mesh/polygons/ear_clipping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/mesh/triangulate_polygons.h"

namespace pdc::detail {
namespace {

/// The mesh of one polygon, triangulated.
Mesh triangulated(Buffer<Vec3f> positions) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.polygons.starts = {0};
  mesh.polygons.corners.resize(mesh.positions.size());
  std::iota(mesh.polygons.corners.begin(), mesh.polygons.corners.end(), 0u);
  triangulatePolygons(mesh);
  EXPECT_EQ(mesh.triangles.size(), mesh.positions.size() - 2);
  return mesh;
}

/// Twice the signed area seen along z.
double signedArea(const Buffer<Vec3f>& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3d a = vecCast<double>(p[i]), b = vecCast<double>(p[(i + 1) % p.size()]);
    sum += a.x * b.y - a.y * b.x;
  }
  return sum / 2;
}

/// The triangles tile a polygon that does not meet itself: they have its area, none is turned or without area, and no
/// two overlap.
void expectTiled(const Buffer<Vec3f>& positions) {
  const Mesh mesh = triangulated(positions);
  const MeshReport report = analyze(mesh);
  const double area = std::abs(signedArea(positions));
  EXPECT_NEAR(report.area, area, 1e-9 * area);
  EXPECT_EQ(report.misorientedEdges, 0u);
  EXPECT_EQ(report.nonManifoldEdges, 0u);
  EXPECT_EQ(report.eulerNumber, 1);
  const SelfIntersections found = selfIntersections(mesh);
  EXPECT_EQ(found.pairs.size(), 0u);
  EXPECT_EQ(found.degenerateTriangles, 0u);
}

TEST(EarClipping, ConvexPolygonsAreFansFromTheirFirstCorner) {
  const Mesh mesh = triangulated({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}});
  EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  // So are those that their first corner sees as a whole.
  const Mesh star = triangulated({{0, 0, 0}, {4, 0, 0}, {2, 1, 0}, {4, 4, 0}, {1, 3, 0}});
  EXPECT_EQ(star.triangles, (Buffer<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(EarClipping, TilesConcavePolygonsFromEachCornerAndBothSides) {
  const std::vector<Buffer<Vec3f>> shapes{
      {{2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}, {2, 0, 0}},
      {{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},
      {{0, 0, 0}, {3, 2, 0}, {6, 0, 0}, {4, 3, 0}, {6, 6, 0}, {3, 4, 0}, {0, 6, 0}, {2, 3, 0}},
      // A spiral.
      {{0, 0, 0},
       {7, 0, 0},
       {7, 7, 0},
       {1, 7, 0},
       {1, 2, 0},
       {5, 2, 0},
       {5, 5, 0},
       {3, 5, 0},
       {3, 4, 0},
       {4, 4, 0},
       {4, 3, 0},
       {2, 3, 0},
       {2, 6, 0},
       {6, 6, 0},
       {6, 1, 0},
       {0, 1, 0}},
      // Corners within straight edges.
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}},
      {{0, 0, 0}, {4, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0.5f, 0.5f, 0}},
  };
  for (const Buffer<Vec3f>& shape : shapes)
    for (std::size_t first = 0; first < shape.size(); ++first)
      for (const bool turned : {false, true}) {
        Buffer<Vec3f> positions = shape;
        std::rotate(positions.begin(), positions.begin() + static_cast<std::ptrdiff_t>(first), positions.end());
        if (turned) std::reverse(positions.begin(), positions.end());
        expectTiled(positions);
      }
}

/// Corners at random distances around a middle, which makes a polygon that does not meet itself.
Buffer<Vec3f> ragged(std::size_t corners, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(0.2, 1);
  Buffer<Vec3f> positions;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners),
                 r = radius(random);
    positions.push_back(vecCast<float>(Vec3d{r * std::cos(angle), r * std::sin(angle), 0}));
  }
  return positions;
}

TEST(EarClipping, TilesRaggedPolygonsOfAllSizes) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) expectTiled(ragged(5 + seed, seed));
}

TEST(EarClipping, TilesSkylinesWithManyCornersOnOneLine) {
  std::mt19937 random(3);
  for (int width = 2; width < 80; ++width) {
    Buffer<Vec3f> positions;
    for (int x = 0; x <= width; ++x) positions.push_back({static_cast<float>(x), 0, 0});
    float before = 0;
    for (int x = width; x > 0; --x) {
      const auto height = static_cast<float>(1 + random() % 4);
      if (height != before) positions.push_back({static_cast<float>(x), height, 0});
      positions.push_back({static_cast<float>(x - 1), height, 0});
      before = height;
    }
    expectTiled(positions);
  }
}

/// A plate with so many teeth, turned about two axes: its caps are polygons whose corners lie on two lines, but for
/// rounding.
Mesh turnedComb(int teeth, double degrees) {
  std::vector<Vec3d> outline{{0, 0, 0}, {2.0 * teeth + 1, 0, 0}};
  for (int i = teeth; i-- > 0;)
    for (const auto& [x, y] : {std::pair{2, 1}, {2, 3}, {1, 3}, {1, 1}})
      outline.push_back({2.0 * i + x, static_cast<double>(y), 0});
  const double a = degrees * std::numbers::pi / 180;
  Mesh mesh;
  for (const double height : {0.0, 1.0})
    for (const Vec3d& p : outline) {
      const Vec3d q{p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), height};
      mesh.positions.push_back(vecCast<float>(
          Vec3d{q.x, q.y * std::cos(a) - q.z * std::sin(a), q.y * std::sin(a) + q.z * std::cos(a)} * 0.37));
    }
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.push_back({i, next, n + next});
    mesh.triangles.push_back({i, n + next, n + i});
  }
  for (std::uint32_t i = 0; i < n; ++i) mesh.polygons.corners.push_back(n - 1 - i);
  for (std::uint32_t i = 0; i < n; ++i) mesh.polygons.corners.push_back(n + i);
  mesh.polygons.starts = {0, n};
  triangulatePolygons(mesh);
  return mesh;
}

TEST(EarClipping, CapsOfTurnedCombsDoNotMeetTheirWalls) {
  for (const int teeth : {3, 10, 50})
    for (const double degrees : {0.0, 17.0, 33.0, 50.0, 71.0}) {
      const Mesh mesh = turnedComb(teeth, degrees);
      const SelfIntersections found = selfIntersections(mesh);
      EXPECT_EQ(found.pairs.size(), 0u) << teeth << " teeth, " << degrees << " degrees";
      EXPECT_EQ(found.degenerateTriangles, 0u) << teeth << " teeth, " << degrees << " degrees";
    }
}

TEST(EarClipping, LooksAtAPolygonAlongItsNormal) {
  // An L in many planes; its area is that of the plane's image.
  for (const Vec3d& u : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{1, 2, -2}, Vec3d{-3, 1, 1}})
    for (const Vec3d& v : {Vec3d{0, 0, 1}, Vec3d{2, -1, 3}, Vec3d{0, 0, -1}}) {
      Buffer<Vec3f> positions;
      for (const auto& [x, y] : {std::pair{2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 0}, {2, 0}})
        positions.push_back(vecCast<float>(u * double(x) + v * double(y)));
      const Mesh mesh = triangulated(positions);
      EXPECT_NEAR(analyze(mesh).area, 3 * length(cross(u, v)), 1e-9);
      EXPECT_EQ(selfIntersections(mesh).pairs.size(), 0u);
    }
}

TEST(EarClipping, AHoleJoinedByAnEdgePassedTwiceStaysOpen) {
  const Mesh mesh = triangulated(
      {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {0, 0, 0}, {2, 2, 0}, {2, 4, 0}, {4, 4, 0}, {4, 2, 0}, {2, 2, 0}});
  const MeshReport report = analyze(mesh);
  EXPECT_EQ(report.area, 32);
  EXPECT_EQ(selfIntersections(mesh).degenerateTriangles, 0u);
}

TEST(EarClipping, PolygonsThatTouchThemselvesAreTiled) {
  const auto areaOf = [](const Buffer<Vec3f>& positions) { return analyze(triangulated(positions)).area; };
  // Two squares that share a corner; a square with an antenna; a plate with two holes.
  EXPECT_EQ(areaOf({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {1, 1, 0}, {0, 1, 0}}), 2);
  EXPECT_EQ(areaOf({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {3, 3, 0}, {1, 1, 0}, {0, 1, 0}}), 1);
  EXPECT_EQ(areaOf({{0, 0, 0},
                    {9, 0, 0},
                    {9, 5, 0},
                    {7, 3, 0},
                    {7, 2, 0},
                    {6, 2, 0},
                    {6, 3, 0},
                    {7, 3, 0},
                    {9, 5, 0},
                    {0, 5, 0},
                    {1, 3, 0},
                    {2, 3, 0},
                    {2, 2, 0},
                    {1, 2, 0},
                    {1, 3, 0},
                    {0, 5, 0}}),
            43);
}

TEST(EarClipping, RepeatedCornersMakeTrianglesWithoutAreaOnly) {
  const Mesh mesh =
      triangulated({{2, 1, 0}, {1, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}, {0, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(analyze(mesh).area, 3);
  EXPECT_EQ(selfIntersections(mesh).degenerateTriangles, 2u);
}

TEST(EarClipping, PolygonsWithoutARightAnswerGetAsManyTriangles) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  triangulated({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {-1, 1, 0}});
  triangulated({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}});
  triangulated({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  triangulated({{0, 0, 0}, {nan, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.5f, 0}});
  triangulated({{0, 0, 0}, {inf, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.5f, 0}});
  triangulated({{3e38f, 0, 0}, {-3e38f, 0, 0}, {3e38f, 3e38f, 0}, {0, 1, 0}, {0.5f, 0.5f, 0}});
  std::mt19937 random(1);
  std::uniform_int_distribution<int> coordinate(0, 6);
  for (std::size_t corners = 5; corners < 400; ++corners) {
    Buffer<Vec3f> positions;
    for (std::size_t i = 0; i < corners; ++i)
      positions.push_back({float(coordinate(random)), float(coordinate(random)), float(coordinate(random))});
    const Mesh mesh = triangulated(positions);
    std::vector<std::size_t> uses(corners);
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) ++uses[v];
    EXPECT_EQ(std::count(uses.begin(), uses.end(), 0u), 0) << "each corner is in a triangle";
  }
}

/// A comb with that many teeth: flat corners along its back are the worst for looking at all of them.
Buffer<Vec3f> comb(std::size_t teeth) {
  Buffer<Vec3f> positions{{float(teeth), -1, 0}, {float(teeth), 0, 0}};
  for (std::size_t i = teeth; i-- > 0;) {
    const float x = float(i);
    for (const auto& [dx, y] : {std::pair{0.75f, 0.0f}, {0.75f, 1.0f}, {0.25f, 1.0f}, {0.25f, 0.0f}})
      positions.push_back({x + dx, y, 0});
  }
  positions.push_back({0, 0, 0});
  positions.push_back({0, -1, 0});
  return positions;
}

TEST(EarClipping, LargePolygonsDoNotTakeTimeQuadratically) {
  expectTiled(comb(50));
  // Trying each corner against all others would take a minute.
  const auto begin = std::chrono::steady_clock::now();
  const auto areaOf = [](const Buffer<Vec3f>& positions) { return analyze(triangulated(positions)).area; };
  EXPECT_NEAR(areaOf(comb(25000)), 25000 * 1.5, 1e-6);
  const Buffer<Vec3f> large = ragged(100000, 7);
  EXPECT_NEAR(areaOf(large), signedArea(large), 1e-6);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 20);
}

TEST(EarClipping, PolygonsOfAReportAreMeasuredAsTheyAreTriangulated) {
  Mesh mesh;
  mesh.positions = {{2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}, {2, 0, 0}};
  mesh.polygons = {.corners = {0, 1, 2, 3, 4, 5}, .starts = {0}};
  EXPECT_EQ(analyze(mesh).area, 3);
}

}  // namespace
}  // namespace pdc::detail
