#include "mesh/connectivity.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "mesh/faces.h"

namespace pdc::detail {
namespace {

/// Triangles and quads of random vertices, some of which they name twice.
Mesh soup(std::uint32_t vertices, std::size_t faces) {
  std::mt19937 random(99);
  Mesh mesh;
  mesh.positions.assign(vertices, Vec3f{0, 0, 0});
  const auto any = [&] { return static_cast<std::uint32_t>(random() % (vertices - 1)); };  // The last has no face.
  for (std::size_t i = 0; i < faces; ++i) {
    if (random() % 2 == 0) {
      mesh.quads.push_back({any(), any(), any(), any()});
    } else {
      mesh.triangles.push_back({any(), any(), any()});
    }
  }
  return mesh;
}

/// Two quads and a triangle about vertex 1, which is on the boundary; vertex 6 has no face.
Mesh strip() {
  Mesh mesh;
  mesh.positions.assign(7, Vec3f{0, 0, 0});
  mesh.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  mesh.triangles = {{2, 1, 0}};
  return mesh;
}

std::vector<std::uint32_t> neighboursOf(const Connectivity& connectivity, std::uint32_t vertex) {
  std::vector<std::uint32_t> neighbours;
  OneRing ring;
  ring.look(connectivity, vertex);
  ring.forEachEdge([&](std::uint32_t neighbour, auto) { neighbours.push_back(neighbour); });
  return neighbours;
}

TEST(Connectivity, CornersOfAVertexAreThoseOfItsFacesInTheirOrder) {
  const Connectivity connectivity(strip());
  ASSERT_EQ(connectivity.vertices(), 7u);
  const auto corners = connectivity.corners(1);
  EXPECT_EQ(std::vector(corners.begin(), corners.end()), (std::vector<Corner>{{0, 0, 4}, {1, 4, 2}, {2, 2, 0}}));
  EXPECT_EQ(connectivity.corners(3).size(), 1u);
  EXPECT_TRUE(connectivity.corners(6).empty());
}

TEST(Connectivity, OfASoupIsWhatItsFacesSay) {
  const Mesh mesh = soup(200, 500);
  std::vector<std::vector<Corner>> expected(mesh.positions.size());
  for (std::size_t i = 0; i < faceCount(mesh); ++i) {
    const auto f = face(mesh, i);
    for (std::size_t k = 0; k < f.size(); ++k)
      expected[f[k]].push_back(
          {static_cast<std::uint32_t>(i), f[(k + f.size() - 1) % f.size()], f[(k + 1) % f.size()]});
  }
  const Connectivity connectivity(mesh);
  for (std::size_t v = 0; v < expected.size(); ++v) {
    std::sort(expected[v].begin(), expected[v].end());
    EXPECT_TRUE(std::ranges::equal(connectivity.corners(v), expected[v])) << v;
  }
}

TEST(Connectivity, PolygonsAreFacesToo) {
  Mesh mesh = strip();
  mesh.polygons.add(std::array<std::uint32_t, 5>{6, 5, 2, 1, 0});
  const auto connectivity = Connectivity(mesh);
  EXPECT_TRUE(std::ranges::equal(connectivity.corners(5), (std::vector<Corner>{{1, 2, 4}, {3, 6, 2}})));
}

TEST(OneRing, NeighboursShareAnEdgeNotOnlyAFace) {
  const Connectivity connectivity(strip());
  EXPECT_EQ(neighboursOf(connectivity, 1), (std::vector<std::uint32_t>{0, 2, 4}));
  EXPECT_EQ(neighboursOf(connectivity, 4), (std::vector<std::uint32_t>{1, 3, 5}));
  EXPECT_EQ(neighboursOf(connectivity, 6), std::vector<std::uint32_t>{});
}

TEST(OneRing, TellsFansFromOtherVertices) {
  const auto isFan = [](std::initializer_list<Triangle> triangles) {
    Mesh mesh;
    mesh.positions.assign(7, Vec3f{0, 0, 0});
    mesh.triangles.assign(triangles);
    const Connectivity connectivity(mesh);
    OneRing ring;
    ring.look(connectivity, 0);
    return ring.isFan();
  };
  EXPECT_TRUE(isFan({{0, 1, 2}}));
  EXPECT_TRUE(isFan({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}})) << "closed";
  EXPECT_TRUE(isFan({{0, 1, 2}, {0, 3, 2}})) << "turned against each other";
  EXPECT_FALSE(isFan({{0, 1, 2}, {0, 3, 4}})) << "two fans";
  EXPECT_FALSE(isFan({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}})) << "two closed ones";
  EXPECT_FALSE(isFan({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}})) << "three faces at an edge";
}

TEST(EdgeTable, EdgesOfAStripWithTheirFaces) {
  const EdgeTable edges{Connectivity(strip())};
  using Edge = std::array<std::uint32_t, 2>;
  std::vector<Edge> all, boundary;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    all.push_back(edges.vertices(e));
    if (edges.isBoundary(e)) boundary.push_back(edges.vertices(e));
  }
  EXPECT_EQ(all, (std::vector<Edge>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {4, 5}}));
  EXPECT_EQ(boundary, (std::vector<Edge>{{0, 2}, {0, 3}, {2, 5}, {3, 4}, {4, 5}}));
  const auto faces = edges.faces(edges.find(4, 1));
  EXPECT_EQ(std::vector(faces.begin(), faces.end()), (std::vector<EdgeFace>{{1, false}, {0, true}}));
  EXPECT_EQ(edges.find(0, 4), EdgeTable::kNone);
  EXPECT_EQ(edges.find(5, 6), EdgeTable::kNone);
  EXPECT_EQ(edges.find(5, 7), EdgeTable::kNone);
}

TEST(EdgeTable, OfASoupIsWhatItsFacesSay) {
  const Mesh mesh = soup(200, 500);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::multiset<EdgeFace>> expected;
  for (std::size_t i = 0; i < faceCount(mesh); ++i) {
    const auto f = face(mesh, i);
    for (std::size_t k = 0; k < f.size(); ++k) {
      const std::uint32_t a = f[k], b = f[(k + 1) % f.size()];
      if (a != b) expected[std::minmax(a, b)].insert({static_cast<std::uint32_t>(i), a < b});
    }
  }
  const EdgeTable edges{Connectivity(mesh)};
  ASSERT_EQ(edges.size(), expected.size());
  std::size_t e = 0;
  for (const auto& [edge, faces] : expected) {
    EXPECT_EQ(edges.vertices(e)[0], edge.first);
    EXPECT_EQ(edges.vertices(e)[1], edge.second);
    EXPECT_EQ(edges.find(edge.second, edge.first), e);
    EXPECT_EQ(std::multiset(edges.faces(e).begin(), edges.faces(e).end()), faces);
    ++e;
  }
}

/// Large enough for many chunks, with vertices that several threads fill at once.
TEST(Connectivity, DoesNotDependOnThreads) {
  const Mesh mesh = soup(5000, 60000);
  const Connectivity expected(mesh);
  const EdgeTable expectedEdges(expected);
  for (const std::size_t threads : {1u, 2u, 8u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Connectivity connectivity(mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      ASSERT_TRUE(std::ranges::equal(connectivity.corners(v), expected.corners(v))) << v;
    const EdgeTable edges(connectivity);
    ASSERT_EQ(edges.size(), expectedEdges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      ASSERT_EQ(edges.vertices(e), expectedEdges.vertices(e));
      ASSERT_TRUE(std::ranges::equal(edges.faces(e), expectedEdges.faces(e))) << e;
    }
  }
}

}  // namespace
}  // namespace pdc::detail
