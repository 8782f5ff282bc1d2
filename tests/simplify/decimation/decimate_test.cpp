#include "pdc/simplify/decimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <set>
#include <stdexcept>

#include "parallel/with_threads.h"
#include "pdc/mesh/distance.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "simplify/quadric_kinds.h"
#include "simplify/same_bytes.h"
#include "simplify/shapes.h"

namespace pdc {
namespace {

using test::cube, test::plate, test::sphere, test::torus, test::sameBytes;

/// Expects a closed oriented manifold of this Euler number.
void expectClosed(const Mesh& mesh, long long eulerNumber) {
  const MeshReport report = analyze(mesh);
  EXPECT_EQ(report.boundaryEdges, 0u);
  EXPECT_EQ(report.nonManifoldEdges + report.nonManifoldVertices + report.misorientedEdges, 0u);
  EXPECT_EQ(report.degenerateFaces + report.duplicateFaces + report.unusedVertices, 0u);
  EXPECT_EQ(report.eulerNumber, eulerNumber);
}

double farthest(const Mesh& from, const Mesh& to) {
  const Buffer<double> all = vertexDistances(from, to);
  return *std::max_element(all.begin(), all.end());
}

TEST(Decimate, KeepsTopologyWithEveryQuadric) {
  const Mesh ball = sphere(20), ring = torus(24);
  for (const QuadricKind kind : test::kQuadricKinds) {
    DecimateReport report;
    const Mesh fewer = decimate(ball, {.faces = 400, .quadric = kind}, &report);
    EXPECT_EQ(fewer.triangles.size(), 400u);
    EXPECT_EQ(report.facesAfter, 400u);
    EXPECT_EQ(report.end, DecimateEnd::kReached);
    expectClosed(fewer, 2);
    expectClosed(decimate(ring, {.ratio = 0.1, .quadric = kind}), 0);
  }
}

TEST(Decimate, SphereStaysNearAndKeepsItsVolume) {
  const Mesh ball = sphere(40);
  const Mesh fewer = decimate(ball, {.faces = 800});
  // A sphere in 800 triangles of its own has a height of 1.1e-2 over each.
  EXPECT_LT(farthest(fewer, ball), 0.012);
  EXPECT_LT(farthest(ball, fewer), 0.012);
  EXPECT_NEAR(analyze(fewer).volume / analyze(ball).volume, 1, 3e-3);
  EXPECT_TRUE(selfIntersections(fewer).pairs.empty());
}

TEST(Decimate, CubeBecomesTwelveTriangles) {
  const Mesh dense = cube(60);
  const auto cornerError = [](const Mesh& mesh) {
    double most = 0;
    for (const Vec3f& p : mesh.positions)
      for (int i = 0; i < 3; ++i) most = std::max(most, std::abs(std::abs(double{p[i]}) - 1));
    return most;
  };
  const Mesh plain = decimate(dense, {.faces = 12, .quadric = QuadricKind::kPlane});
  EXPECT_EQ(plain.triangles.size(), 12u);
  EXPECT_EQ(plain.positions.size(), 8u);
  EXPECT_LT(cornerError(plain), 2e-6);
  const Mesh noisy = decimate(dense, {.faces = 12});
  EXPECT_EQ(noisy.triangles.size(), 12u);
  EXPECT_LT(cornerError(noisy), 1e-4);
}

TEST(Decimate, FlatPlateKeepsItsBoundary) {
  for (const QuadricKind kind : {QuadricKind::kPlane, QuadricKind::kProbabilisticPlane}) {
    const Mesh fewer = decimate(plate(40), {.faces = 2, .quadric = kind});
    const MeshReport report = analyze(fewer);
    EXPECT_EQ(report.triangles, 2u);
    EXPECT_NEAR(report.area, 1, 1e-4);
    EXPECT_EQ(report.bounds.lo[2], 0);
    EXPECT_EQ(report.bounds.hi[2], 0);
  }
}

TEST(Decimate, LockedBoundaryStays) {
  const Mesh fewer = decimate(plate(10), {.faces = 0, .lockBoundary = true});
  const MeshReport report = analyze(fewer);
  EXPECT_EQ(report.boundaryEdges, 40u);
  EXPECT_LE(report.vertices, 41u) << "the last one cannot go to a side without making triangles of that side flat";
  EXPECT_FLOAT_EQ(static_cast<float>(report.area), 1);
}

TEST(Decimate, SubsetMovesNothing) {
  const Mesh ball = sphere(16);
  std::set<std::array<float, 3>> given;
  for (const Vec3f& p : ball.positions) given.insert({p.x, p.y, p.z});
  // Each goes through the local frame and back.
  const Mesh fewer = decimate(ball, {.ratio = 0.1, .placement = CollapsePlacement::kSubset});
  EXPECT_LE(fewer.triangles.size(), ball.triangles.size() / 10);
  for (const Vec3f& p : fewer.positions) EXPECT_TRUE(given.contains({p.x, p.y, p.z}));
}

TEST(Decimate, SameBytesForAnyNumberOfThreads) {
  Mesh ball = sphere(40);
  test::addNoise(ball, 0.003);
  const auto with = [&](int threads) {
    return detail::withThreads(threads, [&] { return decimate(ball, {.ratio = 0.05}); });
  };
  const Mesh one = with(1);
  for (const int threads : {2, 3, 8}) EXPECT_TRUE(sameBytes(with(threads), one)) << threads;
}

TEST(Decimate, UnitOfLengthDoesNotMatter) {
  Mesh ball = sphere(24);
  test::addNoise(ball, 0.01);
  const Mesh fewer = decimate(ball, {.ratio = 0.1});
  for (const float scale : {0x1p-10F, 0x1p10F}) {
    Mesh scaled = ball, expected = fewer;
    for (Vec3f& p : scaled.positions) p *= scale;
    for (Vec3f& p : expected.positions) p *= scale;
    EXPECT_TRUE(sameBytes(decimate(scaled, {.ratio = 0.1}), expected)) << scale;
  }
  Mesh far = ball;
  far.origin = {1e6, -2e6, 3e6};
  const Mesh farFewer = decimate(far, {.ratio = 0.1});
  EXPECT_TRUE(sameBytes(farFewer, fewer));
  EXPECT_EQ(farFewer.origin, far.origin);
}

TEST(Decimate, MovedMeshGivesTheMovedResult) {
  Mesh ball = sphere(24);
  for (Vec3f& p : ball.positions)
    for (int i = 0; i < 3; ++i) p[i] = std::round(p[i] * 0x1p12F) * 0x1p-12F;  // So that moving rounds nothing.
  Mesh moved = ball;
  const Vec3f by{1024, -512, 256};
  for (Vec3f& p : moved.positions) p += by;
  const Mesh fewer = decimate(ball, {.ratio = 0.1}), movedFewer = decimate(moved, {.ratio = 0.1});
  ASSERT_EQ(fewer.triangles, movedFewer.triangles);
  for (std::size_t v = 0; v < fewer.positions.size(); ++v)
    EXPECT_LT(length(vecCast<double>(fewer.positions[v] + by - movedFewer.positions[v])), 2e-4);
}

TEST(Decimate, QuadsStandForTheirTriangles) {
  Mesh triangles = plate(16), quads = triangles;
  quads.triangles.clear();
  for (std::size_t i = 0; i < triangles.triangles.size(); i += 2) {
    const Triangle &t = triangles.triangles[i], &u = triangles.triangles[i + 1];
    quads.quads.push_back({t[0], t[1], t[2], u[2]});
  }
  EXPECT_TRUE(sameBytes(decimate(quads, {.faces = 20}), decimate(triangles, {.faces = 20})));
}

TEST(Decimate, PropertiesAreInterpolated) {
  Mesh mesh = plate(30);
  Buffer<float> x;
  Buffer<std::uint8_t> shade;
  for (const Vec3f& p : mesh.positions) {
    x.insert(x.end(), {p.x, 1 - p.y});
    shade.push_back(200);
  }
  mesh.properties = {{"place", 2, x}, {"shade", 1, shade}};
  mesh.normals.assign(mesh.positions.size(), Vec3f{0, 0, 1});
  const Mesh fewer = decimate(mesh, {.faces = 60});
  const auto place = fewer.values<float>("place");
  ASSERT_EQ(place.size(), 2 * fewer.positions.size());
  for (std::size_t v = 0; v < fewer.positions.size(); ++v) {
    // A vertex beside its edge has what the edge has nearest to it.
    EXPECT_NEAR(place[2 * v], fewer.positions[v].x, 0.1);
    EXPECT_NEAR(place[2 * v + 1], 1 - fewer.positions[v].y, 0.1);
    EXPECT_EQ(fewer.values<std::uint8_t>("shade")[v], 200);
    EXPECT_EQ(fewer.normals[v], (Vec3f{0, 0, 1}));
  }
}

TEST(Decimate, NonManifoldPartsStay) {
  // Two cubes that share an edge.
  Mesh mesh = cube(8);
  const std::size_t size = mesh.positions.size();
  std::vector<std::uint32_t> number(size);
  for (std::size_t v = 0; v < size; ++v) {
    const Vec3f p = mesh.positions[v];
    number[v] = static_cast<std::uint32_t>(v);
    if (p.x == 1 && p.y == 1) continue;
    number[v] = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back({2 - p.x, 2 - p.y, p.z});
  }
  // The second is the first one turned about the edge, so that each vertex on the edge is its own image.
  for (std::size_t t = 0, n = mesh.triangles.size(); t < n; ++t) {
    const Triangle f = mesh.triangles[t];
    mesh.triangles.push_back({number[f[0]], number[f[1]], number[f[2]]});
  }
  DecimateReport report;
  const Mesh fewer = decimate(mesh, {.faces = 100}, &report);
  EXPECT_EQ(report.nonManifoldVertices, 9u);
  EXPECT_EQ(analyze(fewer).nonManifoldEdges, 8u);
  EXPECT_NEAR(analyze(fewer).volume, 16, 1e-3);
  EXPECT_LE(fewer.triangles.size(), 100u);
}

TEST(Decimate, DegenerateAndEmptyMeshes) {
  EXPECT_TRUE(decimate({}, {.faces = 0}).positions.empty());
  Mesh mesh = plate(2);
  mesh.positions.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
  mesh.triangles.push_back({0, 1, 9});
  mesh.triangles.push_back({0, 0, 1});
  DecimateReport report;
  const Mesh fewer = decimate(mesh, {.faces = 100}, &report);
  EXPECT_EQ(report.degenerateFaces, 2u);
  EXPECT_EQ(fewer.triangles.size(), 8u);
  EXPECT_EQ(fewer.positions.size(), 9u);
  // One place for all corners.
  for (Vec3f& p : mesh.positions) p = {1, 1, 1};
  EXPECT_LE(decimate(mesh, {.faces = 1}).triangles.size(), 8u);
}

// Near the target few edges are looked at, and all of those may be such as cannot be collapsed.
TEST(Decimate, ReachesEveryTarget) {
  const Mesh box = cube(50);
  for (std::size_t faces = 300; faces < 30000; faces += 1234) {
    const Mesh fewer = decimate(box, {.faces = faces});
    EXPECT_LE(fewer.triangles.size(), faces);
    EXPECT_GE(fewer.triangles.size() + 2, faces);
  }
}

TEST(Decimate, TetrahedronIsTheLeast) {
  DecimateReport report;
  const Mesh least = decimate(sphere(4), {.faces = 0}, &report);
  EXPECT_EQ(least.triangles.size(), 4u);
  expectClosed(least, 2);
  EXPECT_EQ(report.end, DecimateEnd::kNoCollapseLeft);
}

TEST(Decimate, RefusesOptionsOutOfRange) {
  const Mesh mesh = plate(2);
  const auto refuses = [&](const DecimateOptions& options) {
    EXPECT_THROW(static_cast<void>(decimate(mesh, options)), std::invalid_argument);
  };
  refuses({});
  refuses({.ratio = 0});
  refuses({.ratio = 1.5});
  refuses({.faces = 1, .sigmaNormal = -1});
  refuses({.faces = 1, .sigmaPosition = std::numeric_limits<double>::quiet_NaN()});
  refuses({.faces = 1, .memory = 1.01});
  refuses({.faces = 1, .weld = -1});
  refuses({.faces = 1, .weld = std::numeric_limits<double>::infinity()});
  refuses({.faces = 1, .maxTurn = 91});
  refuses({.faces = 1, .boundaryWeight = -1});
  Mesh broken = mesh;
  broken.triangles.push_back({0, 1, 99});
  EXPECT_THROW(static_cast<void>(decimate(broken, {.faces = 1})), Error);
}

TEST(Decimate, WeldsFirst) {
  const Mesh box = cube(10);
  Mesh soup;
  for (const Triangle& t : box.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) soup.positions.push_back(box.positions[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  soup.triangles.push_back({0, 1, 0});
  const auto last = static_cast<std::uint32_t>(soup.positions.size());
  soup.positions.push_back(soup.positions[0]);
  soup.triangles.push_back({0, 1, last});
  DecimateReport report;
  const Mesh fewer = decimate(soup, {.ratio = 12.0 / 1202, .weld = 0}, &report);
  expectClosed(fewer, 2);
  EXPECT_EQ(fewer.triangles.size(), 12u);
  EXPECT_EQ(report.facesBefore, 1202u);
  EXPECT_EQ(report.verticesBefore, 3601u);
  EXPECT_EQ(report.weldedVertices, 3601u - 602u);
  EXPECT_EQ(report.degenerateFaces, 2u);
  EXPECT_GT(decimate(soup, {.faces = 12}).triangles.size(), 1000u) << "or the test shows nothing";
}

TEST(Decimate, StopsWhenAsked) {
  std::atomic<bool> stop{false};
  const Monitor monitor{.progress = [&](const char*, double) { stop = true; }, .stop = &stop};
  EXPECT_THROW(static_cast<void>(decimate(sphere(20), {.faces = 100}, nullptr, monitor)), Cancelled);
}

/// A sphere whose inside is hollow but for a wall of this thickness.
Mesh shell(int n, float thickness) {
  Mesh mesh = sphere(n);
  const auto size = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t v = 0; v < size; ++v) mesh.positions.push_back(mesh.positions[v] * (1 - thickness));
  for (std::size_t t = 0, count = mesh.triangles.size(); t < count; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    mesh.triangles.push_back({a + size, c + size, b + size});
  }
  return mesh;
}

TEST(Decimate, SoundMeshesStaySound) {
  const Mesh thin = shell(20, 0.004F);
  ASSERT_TRUE(selfIntersections(thin).pairs.empty());
  const Mesh plain = decimate(thin, {.ratio = 0.1});
  EXPECT_GT(selfIntersections(plain).pairs.size(), 10u) << "or the test shows nothing";
  DecimateReport report;
  const Mesh sound = decimate(thin, {.ratio = 0.1, .sound = true}, &report);
  EXPECT_TRUE(selfIntersections(sound).pairs.empty());
  EXPECT_EQ(selfIntersections(sound).degenerateTriangles, 0u);
  EXPECT_GT(report.refusedIntersections, 0u);
  EXPECT_LT(sound.triangles.size(), thin.triangles.size() / 2);
  const MeshReport facts = analyze(sound);
  EXPECT_EQ(facts.components, 2u);
  EXPECT_EQ(facts.nonManifoldEdges + facts.boundaryEdges, 0u);
}

TEST(Decimate, WhatIntersectsBeforeMayStay) {
  Mesh two = sphere(8);
  const auto size = static_cast<std::uint32_t>(two.positions.size());
  for (std::uint32_t v = 0; v < size; ++v) two.positions.push_back(two.positions[v] + Vec3f{1, 0.1F, 0});
  for (std::size_t t = 0, count = two.triangles.size(); t < count; ++t) {
    const auto [a, b, c] = two.triangles[t];
    two.triangles.push_back({a + size, b + size, c + size});
  }
  const std::size_t before = selfIntersections(two).pairs.size();
  ASSERT_GT(before, 0u);
  const Mesh sound = decimate(two, {.ratio = 0.5, .sound = true});
  EXPECT_LE(selfIntersections(sound).pairs.size(), before);
  EXPECT_LE(sound.triangles.size(), two.triangles.size() / 2);
}

TEST(Decimate, FitBringsFacesNearer) {
  const Mesh ball = sphere(40);
  const auto error = [&](bool fit) {
    const Buffer<double> all = vertexDistances(ball, decimate(ball, {.ratio = 0.05, .fit = fit}));
    double sum = 0;
    for (const double d : all) sum += d / static_cast<double>(all.size());
    return sum;
  };
  EXPECT_LT(error(true), 0.95 * error(false));
}

TEST(MeshNoise, IsThatOfTheVertices) {
  Mesh ball = sphere(60);
  EXPECT_LT(meshNoise(ball), 0.005);
  EXPECT_LT(meshNoise(cube(20)), 1e-6);
  // Edges of this sphere are 0.03 long on average.
  double edge = 0;
  for (const Triangle& t : ball.triangles)
    edge += length(vecCast<double>(ball.positions[t[0]] - ball.positions[t[1]])) /
            static_cast<double>(ball.triangles.size());
  test::addNoise(ball, 0.1 * edge);
  EXPECT_NEAR(meshNoise(ball), 0.1, 0.02);
  EXPECT_EQ(meshNoise({}), 0);
}

// Noise spends no triangles: the same number lies nearer to the clean sphere than without memory and noise.
TEST(Decimate, NoiseIsFiltered) {
  const Mesh clean = sphere(60);
  Mesh noisy = clean;
  test::addNoise(noisy, 0.008);
  const auto error = [&](const DecimateOptions& options) {
    const Buffer<double> all = vertexDistances(clean, decimate(noisy, options));
    double sum = 0;
    for (const double d : all) sum += d / static_cast<double>(all.size());
    return sum;
  };
  EXPECT_LT(error({.ratio = 0.05}),
            0.9 * error({.ratio = 0.05, .sigmaNormal = 1e-4, .sigmaPosition = 1e-4, .memory = 0}));
}

}  // namespace
}  // namespace pdc
