#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "pdc/mesh/mesh_report.h"

namespace pdc {
namespace {

/// Faces of the soup as lists of vertices.
std::vector<std::vector<std::uint32_t>> facesOf(const Mesh& mesh) {
  std::vector<std::vector<std::uint32_t>> faces;
  for (const Quad& q : mesh.quads) faces.emplace_back(q.begin(), q.end());
  for (const Triangle& t : mesh.triangles) faces.emplace_back(t.begin(), t.end());
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i)
    faces.emplace_back(mesh.polygons[i].begin(), mesh.polygons[i].end());
  return faces;
}

/// Number of sets of faces connected through what `keys` gives for each of them.
template <typename Keys>
std::size_t connectedSets(const std::vector<std::vector<std::uint32_t>>& faces, Keys&& keys) {
  std::vector<std::size_t> set(faces.size());
  std::iota(set.begin(), set.end(), 0);
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto a = keys(faces[i]), b = keys(faces[j]);
      if (std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) == a.end()) continue;
      const std::size_t from = set[i], to = set[j];
      std::replace(set.begin(), set.end(), from, to);
    }
  return std::set(set.begin(), set.end()).size();
}

/// The definitions taken literally, one vertex after the other.
MeshReport analyzeSlowly(const Mesh& mesh) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  const auto faces = facesOf(mesh);
  std::map<Edge, std::vector<bool>> edges;  // directions
  std::set<std::set<std::uint32_t>> sets;
  MeshReport r;
  for (const auto& f : faces) {
    for (std::size_t k = 0; k < f.size(); ++k) {
      const std::uint32_t a = f[k], b = f[(k + 1) % f.size()];
      edges[std::minmax(a, b)].push_back(a < b);
    }
    r.duplicateFaces += !sets.insert({f.begin(), f.end()}).second;
  }
  r.edges = edges.size();
  for (const auto& [edge, directions] : edges) {
    r.boundaryEdges += directions.size() == 1;
    r.nonManifoldEdges += directions.size() > 2;
    r.misorientedEdges += directions.size() == 2 && directions[0] == directions[1];
  }
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    std::vector<std::vector<std::uint32_t>> around;
    const auto spokes = [v](const std::vector<std::uint32_t>& f) {
      const auto at = static_cast<std::size_t>(std::find(f.begin(), f.end(), v) - f.begin());
      return std::vector{f[(at + 1) % f.size()], f[(at + f.size() - 1) % f.size()]};
    };
    for (const auto& f : faces)
      if (std::find(f.begin(), f.end(), v) != f.end()) around.push_back(f);
    r.unusedVertices += around.empty();
    bool manifold = around.empty() || connectedSets(around, spokes) == 1;
    for (const auto& f : around)
      for (const std::uint32_t w : spokes(f)) manifold &= edges[std::minmax(v, w)].size() <= 2;
    r.nonManifoldVertices += !manifold;
  }
  r.components = connectedSets(faces, [](const auto& f) { return f; });
  return r;
}

TEST(MeshReport, AgreesWithTheDefinitionsOnRandomSoups) {
  std::mt19937 random(2024);
  std::size_t manifold = 0, nonManifold = 0, components = 0;
  for (int round = 0; round < 300; ++round) {
    Mesh mesh;
    const auto vertices = static_cast<std::uint32_t>(4 + random() % 12);
    mesh.positions.assign(vertices, Vec3f{0, 0, 0});
    std::vector<std::uint32_t> order(vertices);
    std::iota(order.begin(), order.end(), 0);
    for (auto faces = 1 + random() % vertices; faces > 0; --faces) {
      std::shuffle(order.begin(), order.end(), random);
      const std::size_t kind = random() % 5;
      if (kind < 2) {
        mesh.quads.push_back({order[0], order[1], order[2], order[3]});
      } else if (kind < 4) {
        mesh.triangles.push_back({order[0], order[1], order[2]});
      } else {
        mesh.polygons.add(std::span(order).first(3 + random() % (vertices - 3)));
      }
    }
    const MeshReport slow = analyzeSlowly(mesh), r = analyze(mesh);
    EXPECT_EQ(r.edges, slow.edges);
    EXPECT_EQ(r.boundaryEdges, slow.boundaryEdges);
    EXPECT_EQ(r.nonManifoldEdges, slow.nonManifoldEdges);
    EXPECT_EQ(r.misorientedEdges, slow.misorientedEdges);
    EXPECT_EQ(r.nonManifoldVertices, slow.nonManifoldVertices);
    EXPECT_EQ(r.unusedVertices, slow.unusedVertices);
    EXPECT_EQ(r.duplicateFaces, slow.duplicateFaces);
    EXPECT_EQ(r.components, slow.components);
    manifold += slow.nonManifoldVertices == 0;
    nonManifold += slow.nonManifoldVertices > 0;
    components += slow.components > 1;
  }
  EXPECT_GT(manifold, 20u);
  EXPECT_GT(nonManifold, 20u);
  EXPECT_GT(components, 5u);
}

}  // namespace
}  // namespace pdc
