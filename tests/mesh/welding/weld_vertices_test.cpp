#include "pdc/mesh/weld_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <limits>
#include <numeric>
#include <random>

#include "folders.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/mesh/mesh_report.h"
#include "simplify/shapes.h"

namespace pdc {
namespace {

/// Each triangle with corners of its own, which lie within `off` of where they were along each axis.
Mesh soupOf(const Mesh& mesh, float off) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> by(-off, off);
  Mesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) {
      const Vec3f d = off > 0 ? Vec3f{by(engine), by(engine), by(engine)} : Vec3f{};
      soup.positions.push_back(mesh.positions[v] + d);
    }
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  return soup;
}

/// Vertices on a line, which no face uses.
Mesh lineOf(const std::vector<float>& places) {
  Mesh mesh;
  for (const float x : places) mesh.positions.push_back({x, 0, 0});
  return mesh;
}

TEST(WeldVertices, ZeroWeldsEqualPositionsOnly) {
  Mesh mesh = lineOf({0, 1, -0.0F, 1, std::nextafter(1.0F, 2.0F)});
  const WeldReport report = weldVertices(mesh, 0);
  EXPECT_EQ(report.weldedVertices, 2u);
  EXPECT_EQ(mesh.positions, lineOf({0, 1, std::nextafter(1.0F, 2.0F)}).positions);
  EXPECT_EQ(weldVertices(mesh, 0).weldedVertices, 0u);
}

TEST(WeldVertices, SoupBecomesClosed) {
  const Mesh cube = test::cube(8);
  for (const float off : {0.0F, 1e-4F}) {
    Mesh soup = soupOf(cube, off);
    EXPECT_TRUE(isSoup(soup));
    EXPECT_EQ(analyze(soup).boundaryEdges, 3 * cube.triangles.size());
    const WeldReport report = weldVertices(soup, 10 * off);
    EXPECT_EQ(report.weldedVertices, 3 * cube.triangles.size() - cube.positions.size());
    EXPECT_EQ(report.collapsedFaces, 0u);
    const MeshReport facts = analyze(soup);
    EXPECT_EQ(facts.vertices, cube.positions.size());
    EXPECT_EQ(facts.boundaryEdges + facts.nonManifoldEdges + facts.misorientedEdges, 0u);
    EXPECT_EQ(facts.eulerNumber, 2);
    EXPECT_FALSE(isSoup(soup));
  }
}

TEST(WeldVertices, ReachesAsFarAsTheDistanceAndNoFarther) {
  for (const double distance : {1e-30, 1e-3, 1.0, 1e6}) {
    const auto at = [&](double share) { return lineOf({0, static_cast<float>(share * distance)}); };
    Mesh within = at(0.999), beyond = at(1.001);
    EXPECT_EQ(weldVertices(within, distance).weldedVertices, 1u) << distance;
    EXPECT_EQ(weldVertices(beyond, distance).weldedVertices, 0u) << distance;
  }
}

TEST(WeldVertices, ChainsMerge) {
  Mesh mesh = lineOf({3, 0, 1, 4.5F, 2});
  EXPECT_EQ(weldVertices(mesh, 1.1).weldedVertices, 3u);
  EXPECT_EQ(mesh.positions, lineOf({3, 4.5F}).positions) << "the lowest number stays";
}

// Against all pairs, with points that lie in neighbouring cells in every way.
TEST(WeldVertices, AreThoseThatAllPairsGive) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> coordinate(-1, 1);
  for (const double distance : {0.02, 0.05, 0.1, 0.4}) {
    Mesh mesh;
    for (int i = 0; i < 2000; ++i)
      mesh.positions.push_back({coordinate(engine), coordinate(engine), coordinate(engine)});
    std::vector<std::uint32_t> group(mesh.positions.size());
    std::iota(group.begin(), group.end(), 0U);
    for (std::uint32_t a = 0; a < group.size(); ++a)
      for (std::uint32_t b = 0; b < a; ++b) {
        const Vec3d gap = vecCast<double>(mesh.positions[a]) - vecCast<double>(mesh.positions[b]);
        if (group[a] == group[b] || !(dot(gap, gap) <= distance * distance)) continue;
        const std::uint32_t low = std::min(group[a], group[b]), high = std::max(group[a], group[b]);
        std::replace(group.begin(), group.end(), high, low);
      }
    Mesh expected;
    for (std::uint32_t v = 0; v < group.size(); ++v)
      if (group[v] == v) expected.positions.push_back(mesh.positions[v]);
    weldVertices(mesh, distance);
    EXPECT_EQ(mesh.positions, expected.positions) << distance;
  }
}

TEST(WeldVertices, GroupsDoNotDependOnTheOrder) {
  Mesh mesh = soupOf(test::sphere(6), 0.01F), turned = mesh;
  std::reverse(turned.positions.begin(), turned.positions.end());
  EXPECT_EQ(weldVertices(mesh, 0.02).weldedVertices, weldVertices(turned, 0.02).weldedVertices);
}

TEST(WeldVertices, TakesAnyDistanceInTime) {
  const Mesh cube = test::cube(40);
  for (const double distance : {1e-300, 1e-45, 3.0, 1e300}) {
    Mesh mesh = cube;
    mesh.positions[0].x = 1e30F;  // One that is far off must not put the others into one cell.
    weldVertices(mesh, distance);
    EXPECT_EQ(mesh.positions.size(), distance < 1 ? cube.positions.size() : distance < 1e9 ? 2 : 1) << distance;
  }
}

TEST(WeldVertices, VerticesKeepWhatIsTheirs) {
  Mesh mesh = lineOf({5, 5, 7});
  mesh.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.properties = {{"pair", 2, Buffer<float>{1, 2, 3, 4, 5, 6}}};
  weldVertices(mesh, 0);
  EXPECT_EQ(mesh.normals, (Buffer<Vec3f>{{1, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(std::get<Buffer<float>>(mesh.properties[0].values), (Buffer<float>{1, 2, 5, 6}));
}

TEST(WeldVertices, FacesThatCollapseGo) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}};
  mesh.quads = {{0, 1, 2, 3}, {0, 1, 4, 3}, {1, 2, 4, 3}};
  mesh.triangles = {{1, 4, 2}, {0, 0, 4}, {0, 4, 2}};
  EXPECT_EQ(weldVertices(mesh, 0).collapsedFaces, 2u);
  EXPECT_EQ(mesh.quads, (Buffer<Quad>{{0, 1, 2, 3}}));
  // What is left of the second quad, what was degenerate before, and what is whole.
  EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 3}, {0, 0, 1}, {0, 1, 2}}));
}

TEST(WeldVertices, WhatIsNotFiniteStays) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  Mesh mesh = lineOf({nan, nan, inf, inf, 1, 1});
  EXPECT_EQ(weldVertices(mesh, 1e30).weldedVertices, 1u);
  EXPECT_EQ(mesh.positions.size(), 5u);
}

TEST(WeldVertices, RefusesAndStops) {
  Mesh mesh = test::plate(2);
  EXPECT_THROW(weldVertices(mesh, -1), std::invalid_argument);
  EXPECT_THROW(weldVertices(mesh, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(weldVertices(mesh, std::numeric_limits<double>::infinity()), std::invalid_argument);
  const std::atomic<bool> stop{true};
  EXPECT_THROW(weldVertices(mesh, 0, {.progress = {}, .stop = &stop}), Cancelled);
  mesh.triangles.push_back({0, 1, 99});
  EXPECT_THROW(weldVertices(mesh, 0), Error);
  EXPECT_THROW(static_cast<void>(isSoup(mesh)), Error);
}

TEST(WeldVertices, OneFaceIsNoSoup) {
  Mesh mesh = lineOf({0, 1, 2});
  EXPECT_FALSE(isSoup(mesh));
  mesh.triangles = {{0, 1, 2}};
  EXPECT_FALSE(isSoup(mesh));
  EXPECT_FALSE(isSoup(test::plate(1)));
}

// Parts whose vertices differ by rounding, so that reading, which welds equal positions, leaves cracks.
TEST(WeldVertices, RealPartsBecomeClosed) {
  for (const char* const name : {"cad_featuretype.stl", "cad_angle_block.stl"}) {
    const std::filesystem::path path = test::dataFolder() / "mesh" / name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    Mesh mesh = readMesh(path);
    EXPECT_GT(analyze(mesh).boundaryEdges, 0u) << name;
    const Box box = analyze(mesh).bounds;
    weldVertices(mesh, 1e-6 * length(box.hi - box.lo));
    const MeshReport facts = analyze(mesh);
    EXPECT_EQ(facts.boundaryEdges + facts.nonManifoldEdges + facts.misorientedEdges, 0u) << name;
  }
}

}  // namespace
}  // namespace pdc
