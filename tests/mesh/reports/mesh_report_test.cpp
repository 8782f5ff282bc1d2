#include "pdc/mesh/mesh_report.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "pdc/error.h"

namespace pdc {
namespace {

Mesh makeMesh(std::initializer_list<Vec3f> positions, std::initializer_list<Quad> quads,
              std::initializer_list<Triangle> triangles) {
  Mesh mesh;
  mesh.positions.assign(positions);
  mesh.quads.assign(quads);
  mesh.triangles.assign(triangles);
  return mesh;
}

Mesh tetrahedron() {
  return makeMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

/// Side 2, outward faces.
Mesh cube() {
  return makeMesh({{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
                  {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}, {});
}

/// Quads around a torus of radii 2 and 0.5.
Mesh torus(std::uint32_t major, std::uint32_t minor) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < major; ++i)
    for (std::uint32_t j = 0; j < minor; ++j) {
      const double u = 2 * std::numbers::pi * i / major, v = 2 * std::numbers::pi * j / minor;
      const double r = 2 + 0.5 * std::cos(v);
      mesh.positions.push_back(vecCast<float>(Vec3d{r * std::cos(u), r * std::sin(u), 0.5 * std::sin(v)}));
      const auto at = [&](std::uint32_t a, std::uint32_t b) { return (a % major) * minor + b % minor; };
      mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

void append(Mesh& mesh, const Mesh& other) {
  const auto offset = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (Quad q : other.quads) {
    for (auto& v : q) v += offset;
    mesh.quads.push_back(q);
  }
  for (Triangle t : other.triangles) {
    for (auto& v : t) v += offset;
    mesh.triangles.push_back(t);
  }
}

/// No complaint of any kind.
void expectClosedManifold(const MeshReport& r) {
  EXPECT_EQ(r.boundaryEdges, 0u);
  EXPECT_EQ(r.nonManifoldEdges, 0u);
  EXPECT_EQ(r.misorientedEdges, 0u);
  EXPECT_EQ(r.nonManifoldVertices, 0u);
  EXPECT_EQ(r.unusedVertices, 0u);
  EXPECT_EQ(r.degenerateFaces, 0u);
  EXPECT_EQ(r.duplicateFaces, 0u);
  EXPECT_EQ(r.nonFiniteVertices, 0u);
}

TEST(MeshReport, BoundsAreInTheWorldAndTheRestDoesNotDependOnTheOrigin) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const MeshReport there = analyze(mesh);
  mesh.origin = {4649776.1, -1e9, 0.3};
  const MeshReport far = analyze(mesh);
  EXPECT_EQ(far.bounds, (Box{mesh.origin, mesh.origin + Vec3d{1, 1, 1}}));
  EXPECT_EQ(far.volume, there.volume);
  EXPECT_EQ(far.area, there.area);
}

TEST(MeshReport, EmptyMesh) {
  const MeshReport r = analyze(Mesh{});
  expectClosedManifold(r);
  EXPECT_EQ(r.vertices + r.quads + r.triangles + r.edges + r.components, 0u);
  EXPECT_EQ(r.eulerNumber, 0);
  EXPECT_EQ(r.area, 0);
  EXPECT_EQ(r.volume, 0);
  EXPECT_EQ(r.bounds.lo, (Vec3d{0, 0, 0}));
  EXPECT_EQ(r.bounds.hi, (Vec3d{0, 0, 0}));
}

TEST(MeshReport, Tetrahedron) {
  const MeshReport r = analyze(tetrahedron());
  expectClosedManifold(r);
  EXPECT_EQ(r.vertices, 4u);
  EXPECT_EQ(r.triangles, 4u);
  EXPECT_EQ(r.edges, 6u);
  EXPECT_EQ(r.components, 1u);
  EXPECT_EQ(r.eulerNumber, 2);
  EXPECT_NEAR(r.area, 1.5 + std::sqrt(3.0) / 2, 1e-15);
  EXPECT_NEAR(r.volume, 1.0 / 6, 1e-15);
  EXPECT_EQ(r.bounds.hi, (Vec3d{1, 1, 1}));
}

TEST(MeshReport, CubeOfQuads) {
  const MeshReport r = analyze(cube());
  expectClosedManifold(r);
  EXPECT_EQ(r.quads, 6u);
  EXPECT_EQ(r.edges, 12u);
  EXPECT_EQ(r.eulerNumber, 2);
  EXPECT_DOUBLE_EQ(r.area, 24);
  EXPECT_DOUBLE_EQ(r.volume, 8);
  EXPECT_EQ(r.bounds.lo, (Vec3d{-1, -1, -1}));
}

TEST(MeshReport, VolumeFarFromTheOriginIsExact) {
  Mesh mesh = cube();
  for (Vec3f& p : mesh.positions) p += Vec3f{4e6f, -4e6f, 4e6f};
  EXPECT_DOUBLE_EQ(analyze(mesh).volume, 8);
}

TEST(MeshReport, InsideOutVolumeIsNegative) {
  Mesh mesh = cube();
  for (Quad& q : mesh.quads) std::swap(q[1], q[3]);
  const MeshReport r = analyze(mesh);
  expectClosedManifold(r);
  EXPECT_DOUBLE_EQ(r.volume, -8);
}

TEST(MeshReport, QuadIsMeasuredAlongItsDiagonal) {
  // Corner 2 is lifted: the two triangles share the edge 0-2.
  const MeshReport r = analyze(makeMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}, {{0, 1, 2, 3}}, {}));
  EXPECT_NEAR(r.area, std::sqrt(2.0), 1e-15);
}

TEST(MeshReport, OpenSquare) {
  const MeshReport r = analyze(makeMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, {}));
  EXPECT_EQ(r.edges, 4u);
  EXPECT_EQ(r.boundaryEdges, 4u);
  EXPECT_EQ(r.nonManifoldVertices, 0u);
  EXPECT_EQ(r.eulerNumber, 1);
  EXPECT_DOUBLE_EQ(r.area, 1);
  EXPECT_DOUBLE_EQ(r.volume, 0);
}

TEST(MeshReport, BowTieOfTwoTrianglesAtAVertex) {
  const MeshReport r =
      analyze(makeMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {}, {{0, 1, 2}, {0, 3, 4}}));
  EXPECT_EQ(r.nonManifoldVertices, 1u);
  EXPECT_EQ(r.nonManifoldEdges, 0u);
  EXPECT_EQ(r.components, 1u);
  EXPECT_EQ(r.boundaryEdges, 6u);
}

TEST(MeshReport, TwoClosedSolidsThatTouchAtAVertex) {
  Mesh mesh = cube();
  append(mesh, cube());
  for (Quad& q : mesh.quads)
    for (auto& v : q) v = v == 8 ? 6 : v;  // corner 0 of the second cube becomes corner 6 of the first
  const MeshReport r = analyze(mesh);
  EXPECT_EQ(r.nonManifoldVertices, 1u);
  EXPECT_EQ(r.nonManifoldEdges, 0u);
  EXPECT_EQ(r.boundaryEdges, 0u);
  EXPECT_EQ(r.components, 1u);
  EXPECT_EQ(r.unusedVertices, 1u);
  EXPECT_EQ(r.eulerNumber, 15 - 24 + 12);
}

TEST(MeshReport, ThreeFacesOnAnEdge) {
  const MeshReport r = analyze(
      makeMesh({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, {}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_EQ(r.edges, 7u);
  EXPECT_EQ(r.nonManifoldEdges, 1u);
  EXPECT_EQ(r.misorientedEdges, 0u);
  EXPECT_EQ(r.nonManifoldVertices, 2u);
  EXPECT_EQ(r.boundaryEdges, 6u);
}

TEST(MeshReport, MisorientedPair) {
  const MeshReport r = analyze(makeMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {}, {{0, 1, 2}, {0, 1, 3}}));
  EXPECT_EQ(r.misorientedEdges, 1u);
  EXPECT_EQ(r.nonManifoldEdges, 0u);
  EXPECT_EQ(r.nonManifoldVertices, 0u);
  EXPECT_EQ(r.edges, 5u);
}

TEST(MeshReport, DuplicatesWhateverTheOrder) {
  Mesh mesh = makeMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 5}}, {{0, 1, 2, 3}, {2, 1, 0, 3}},
                       {{0, 1, 4}, {4, 0, 1}, {1, 0, 4}, {1, 2, 4}});
  const MeshReport r = analyze(mesh);
  EXPECT_EQ(r.duplicateFaces, 3u);
  EXPECT_EQ(r.degenerateFaces, 0u);
}

TEST(MeshReport, DegenerateFaces) {
  const MeshReport r = analyze(
      makeMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 3, 3}}, {{0, 0, 1}, {2, 2, 2}, {0, 1, 2}}));
  EXPECT_EQ(r.degenerateFaces, 3u);
  EXPECT_DOUBLE_EQ(r.area, 1);
}

/// The cube's faces with the middle of each edge as a corner more.
Mesh cubeOfOctagons() {
  const Mesh plain = cube();
  Mesh mesh;
  mesh.positions = plain.positions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  for (const Quad& q : plain.quads) {
    std::vector<std::uint32_t> octagon;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t a = q[k], b = q[(k + 1) % 4];
      const auto [it, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
      if (isNew) mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) * 0.5F);
      octagon.insert(octagon.end(), {a, it->second});
    }
    mesh.polygons.add(octagon);
  }
  return mesh;
}

TEST(MeshReport, CubeOfPolygons) {
  const MeshReport r = analyze(cubeOfOctagons());
  expectClosedManifold(r);
  EXPECT_EQ(r.vertices, 20u);
  EXPECT_EQ(r.quads + r.triangles, 0u);
  EXPECT_EQ(r.polygons, 6u);
  EXPECT_EQ(r.edges, 24u);
  EXPECT_EQ(r.components, 1u);
  EXPECT_EQ(r.eulerNumber, 2);
  EXPECT_DOUBLE_EQ(r.area, 24);
  EXPECT_DOUBLE_EQ(r.volume, 8);
}

TEST(MeshReport, FaultsOfPolygons) {
  Mesh mesh;
  mesh.positions.assign(6, Vec3f{0, 0, 0});
  mesh.quads = {{0, 1, 2, 3}};
  const auto add = [&](std::initializer_list<std::uint32_t> polygon) { mesh.polygons.add(std::vector(polygon)); };
  add({0, 1, 2, 3, 4});
  add({4, 3, 2, 1, 0});
  EXPECT_EQ(analyze(mesh).duplicateFaces, 1u);
  add({0, 1, 2, 3, 5});
  EXPECT_EQ(analyze(mesh).duplicateFaces, 1u);
  EXPECT_EQ(analyze(mesh).degenerateFaces, 0u);
  add({3, 2, 1, 0, 1});
  EXPECT_EQ(analyze(mesh).duplicateFaces, 2u) << "of the quad";
  EXPECT_EQ(analyze(mesh).degenerateFaces, 1u);
}

TEST(MeshReport, TwoComponents) {
  Mesh mesh = cube();
  append(mesh, tetrahedron());
  const MeshReport r = analyze(mesh);
  expectClosedManifold(r);
  EXPECT_EQ(r.components, 2u);
  EXPECT_EQ(r.eulerNumber, 4);
}

TEST(MeshReport, Torus) {
  const MeshReport r = analyze(torus(200, 80));
  expectClosedManifold(r);
  EXPECT_EQ(r.eulerNumber, 0);
  EXPECT_EQ(r.edges, 2u * 200 * 80);
  EXPECT_EQ(r.components, 1u);
  const double pi2 = std::numbers::pi * std::numbers::pi;
  EXPECT_NEAR(r.volume, 2 * pi2 * 2 * 0.25, 0.02);
  EXPECT_NEAR(r.area, 4 * pi2 * 2 * 0.5, 0.04);
}

TEST(MeshReport, NonFiniteVertexIsLeftOut) {
  Mesh mesh = cube();
  append(mesh, tetrahedron());
  mesh.positions[8].y = std::numeric_limits<float>::quiet_NaN();
  mesh.positions[9].x = std::numeric_limits<float>::infinity();
  const MeshReport r = analyze(mesh);
  EXPECT_EQ(r.nonFiniteVertices, 2u);
  EXPECT_EQ(r.eulerNumber, 4);
  EXPECT_DOUBLE_EQ(r.area, 24);
  EXPECT_DOUBLE_EQ(r.volume, 8);
  EXPECT_EQ(r.bounds.hi, (Vec3d{1, 1, 1}));
}

TEST(MeshReport, UnusedVerticesCountForNothingElse) {
  Mesh mesh = cube();
  mesh.positions.push_back({100, 100, 100});
  const MeshReport r = analyze(mesh);
  EXPECT_EQ(r.vertices, 9u);
  EXPECT_EQ(r.unusedVertices, 1u);
  EXPECT_EQ(r.eulerNumber, 2);
  EXPECT_EQ(r.bounds.hi, (Vec3d{1, 1, 1}));
}

TEST(MeshReport, AFanOfAThousandFaces) {
  Mesh mesh;
  mesh.positions.push_back({0, 0, 0});
  constexpr std::uint32_t kFaces = 1000;
  for (std::uint32_t i = 0; i < kFaces; ++i) {
    const double u = 2 * std::numbers::pi * i / kFaces;
    mesh.positions.push_back(vecCast<float>(Vec3d{std::cos(u), std::sin(u), 0}));
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % kFaces});
  }
  EXPECT_EQ(analyze(mesh).nonManifoldVertices, 0u);
  EXPECT_EQ(analyze(mesh).boundaryEdges, kFaces);
  mesh.triangles.erase(mesh.triangles.begin() + 10);
  EXPECT_EQ(analyze(mesh).nonManifoldVertices, 0u) << "an open fan is one fan";
  mesh.triangles.erase(mesh.triangles.begin() + 500);
  EXPECT_EQ(analyze(mesh).nonManifoldVertices, 1u) << "two open fans are not";
}

TEST(MeshReport, FaceOfAMissingVertexIsAnError) {
  Mesh mesh = tetrahedron();
  mesh.triangles[2][1] = 4;
  try {
    static_cast<void>(analyze(mesh));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "face 2 names vertex 4, but the mesh has 4 vertices");
  }
}

/// The mesh is large enough for many chunks, and the sums are not exact, so that their order would show.
TEST(MeshReport, DoesNotDependOnThreads) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> noise(-1e-3f, 1e-3f);
  Mesh mesh = torus(300, 150);
  for (Vec3f& p : mesh.positions) p += Vec3f{noise(random), noise(random), noise(random)};
  append(mesh, torus(100, 50));
  const MeshReport all = analyze(mesh);
  EXPECT_EQ(all.components, 2u);
  for (const std::size_t threads : {1u, 2u, 8u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const MeshReport r = analyze(mesh);
    EXPECT_EQ(r.area, all.area);
    EXPECT_EQ(r.volume, all.volume);
    EXPECT_EQ(r.edges, all.edges);
    EXPECT_EQ(r.components, all.components);
  }
}

}  // namespace
}  // namespace pdc
