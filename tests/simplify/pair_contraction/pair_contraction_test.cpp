#include "simplify/pair_contraction/pair_contraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <set>
#include <stdexcept>

#include "parallel/with_threads.h"
#include "pdc/mesh/mesh_report.h"
#include "simplify/quadric_kinds.h"
#include "simplify/same_bytes.h"
#include "simplify/shapes.h"

namespace pdc {
namespace {

using test::cube, test::plate, test::sphere, test::torus, test::sameBytes;

/// Adds a mesh to another, moved.
void add(Mesh& mesh, const Mesh& other, const Vec3f& by) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3f& p : other.positions) mesh.positions.push_back(p + by);
  for (const Triangle& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// Two closed plates of 2 x 2 x 0.2, this gap apart.
Mesh plates(float gap) {
  Mesh thin = cube(16);
  for (Vec3f& p : thin.positions) p.z *= 0.1F;
  Mesh two = thin;
  add(two, thin, {0, 0, 0.2F + gap});
  return two;
}

/// Each triangle with corners of its own.
Mesh unwelded(const Mesh& mesh) {
  Mesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) soup.positions.push_back(mesh.positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

/// Expects a closed oriented manifold of one piece and this Euler number.
void expectClosed(const Mesh& mesh, long long eulerNumber) {
  const MeshReport report = analyze(mesh);
  EXPECT_EQ(report.boundaryEdges, 0u);
  EXPECT_EQ(report.nonManifoldEdges + report.nonManifoldVertices + report.misorientedEdges, 0u);
  EXPECT_EQ(report.degenerateFaces + report.duplicateFaces + report.unusedVertices, 0u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.eulerNumber, eulerNumber);
}

TEST(PairContraction, PlatesMergeWhereTheirGapIsLessThanTheDistance) {
  const float gap = 0.03F;
  const Mesh two = plates(gap);
  DecimateReport report;
  const Mesh one = decimate(two, {.faces = 12, .pairDistance = 1.05 * gap}, &report);
  ASSERT_TRUE(report.pairs);
  EXPECT_EQ(report.pairs->componentsBefore, 2u);
  EXPECT_EQ(report.pairs->componentsAfter, 1u);
  EXPECT_EQ(report.pairs->merges, 4u) << "the corners of the walls";
  EXPECT_EQ(report.pairs->nonManifoldEdges + report.pairs->nonManifoldVertices, 0u);
  EXPECT_EQ(one.triangles.size(), 12u);
  expectClosed(one, 2);
  EXPECT_NEAR(analyze(one).volume, 4 * (0.4 + gap), 1e-4) << "the gap is solid";

  const Mesh apart = decimate(two, {.faces = 24, .pairDistance = 0.95 * gap}, &report);
  EXPECT_EQ(report.pairs->merges, 0u);
  EXPECT_EQ(report.pairs->componentsAfter, 2u);
  EXPECT_EQ(analyze(apart).components, 2u);
  EXPECT_NEAR(analyze(apart).volume, 4 * 0.4, 1e-4);
}

TEST(PairContraction, RowOfCubesBecomesABar) {
  Mesh row;
  for (int i = 0; i < 5; ++i) add(row, cube(6), {2.05F * static_cast<float>(i), 0, 0});
  for (const QuadricKind kind : {QuadricKind::kPlane, QuadricKind::kProbabilisticPlane, QuadricKind::kTriangle}) {
    DecimateReport report;
    const Mesh bar = decimate(row, {.faces = 12, .quadric = kind, .pairDistance = 0.06}, &report);
    EXPECT_EQ(report.pairs->componentsBefore, 5u);
    EXPECT_EQ(bar.triangles.size(), 12u);
    expectClosed(bar, 2);
    EXPECT_NEAR(analyze(bar).volume, 4 * 10.2, 1e-3);
  }
}

TEST(PairContraction, ClosedManifoldWithoutClosePairsStaysOne) {
  const Mesh ball = sphere(20), ring = torus(24);
  for (const QuadricKind kind : test::kQuadricKinds) {
    DecimateReport report;
    const Mesh fewer = decimate(ball, {.faces = 400, .quadric = kind, .pairDistance = 0.01}, &report);
    EXPECT_EQ(fewer.triangles.size(), 400u);
    EXPECT_EQ(report.end, DecimateEnd::kReached);
    EXPECT_EQ(report.pairs->merges + report.pairs->duplicateFaces, 0u);
    expectClosed(fewer, 2);
    const Mesh fewerOfRing = decimate(ring, {.ratio = 0.1, .quadric = kind, .pairDistance = 0.01});
    EXPECT_EQ(fewerOfRing.triangles.size(), ring.triangles.size() / 10);
    expectClosed(fewerOfRing, 0);
    // Points know nothing of the faces between them.
    const double shrinkage = kind == QuadricKind::kPoint ? 0.15 : 0.05;
    EXPECT_NEAR(analyze(fewerOfRing).volume / analyze(ring).volume, 1, shrinkage);
  }
  DecimateReport report;
  EXPECT_EQ(decimate(sphere(4), {.faces = 0, .pairDistance = 0.01}, &report).triangles.size(), 4u);
  EXPECT_EQ(report.end, DecimateEnd::kNoCollapseLeft);
}

TEST(PairContraction, SoupBecomesASurface) {
  DecimateReport report;
  const Mesh soup = unwelded(cube(8));
  const Mesh surface = decimate(soup, {.faces = 12, .pairDistance = 1e-3}, &report);
  EXPECT_EQ(report.pairs->componentsBefore, 768u);
  EXPECT_EQ(report.pairs->componentsAfter, 1u);
  EXPECT_EQ(surface.triangles.size(), 12u);
  expectClosed(surface, 2);
  EXPECT_NEAR(analyze(surface).volume, 8, 1e-4);
}

/// Two triangles above each other, a hundredth apart.
Mesh twoTriangles(bool lowerLooksUp, bool upperLooksUp) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.01F}, {1, 0, 0.01F}, {0, 1, 0.01F}};
  mesh.triangles = {lowerLooksUp ? Triangle{0, 1, 2} : Triangle{0, 2, 1},
                    upperLooksUp ? Triangle{3, 4, 5} : Triangle{3, 5, 4}};
  return mesh;
}

TEST(PairContraction, OneOfTwoFacesIsLeftButOfTheWallsOfAGap) {
  for (const bool lower : {false, true})
    for (const bool upper : {false, true}) {
      DecimateReport report;
      const Mesh one = decimate(twoTriangles(lower, upper), {.faces = 1, .pairDistance = 0.02}, &report);
      const bool isGap = lower && !upper;
      EXPECT_EQ(one.triangles.size(), isGap ? 0u : 1u);
      EXPECT_EQ(report.pairs->merges, 3u);
      EXPECT_EQ(report.pairs->duplicateFaces, isGap ? 2u : 1u);
      for (const Vec3f& p : one.positions) EXPECT_NEAR(p.z, 0.005F, 1e-6F);
    }
}

TEST(PairContraction, SurfaceMayStopBeingAManifold) {
  // Two tips that touch in a point.
  Mesh tips = sphere(12);
  add(tips, sphere(12), {2.001F, 0, 0});
  DecimateReport report;
  const Mesh joined = decimate(tips, {.faces = 200, .pairDistance = 0.002}, &report);
  EXPECT_EQ(report.pairs->merges, 1u);
  EXPECT_EQ(report.pairs->componentsAfter, 1u);
  EXPECT_EQ(report.pairs->nonManifoldVertices, 1u);
  EXPECT_EQ(analyze(joined).nonManifoldVertices, 1u);
  EXPECT_EQ(report.pairs->nonManifoldEdges, 0u);
}

TEST(PairContraction, NonManifoldPartsAreDecimatedToo) {
  // Three plates that share a side.
  Mesh fan = plate(10);
  for (const int turn : {1, 2}) {
    std::vector<std::uint32_t> number;
    const Mesh other = plate(10);
    for (std::uint32_t v = 0; v < other.positions.size(); ++v) {
      const Vec3f p = other.positions[v];
      number.push_back(p.y == 0 ? v : static_cast<std::uint32_t>(fan.positions.size()));
      if (p.y != 0) fan.positions.push_back(turn == 1 ? Vec3f{p.x, 0, p.y} : Vec3f{p.x, -p.y, 0});
    }
    for (const Triangle& t : other.triangles) fan.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  }
  ASSERT_EQ(analyze(fan).nonManifoldEdges, 10u);
  DecimateReport report;
  const Mesh least = decimate(fan, {.faces = 6, .pairDistance = 0.01}, &report);
  EXPECT_EQ(least.triangles.size(), 6u);
  EXPECT_EQ(report.pairs->nonManifoldEdges, 1u);
  EXPECT_NEAR(analyze(least).area, 3, 0.01);
  EXPECT_GT(decimate(fan, {.faces = 6}).triangles.size(), 20u) << "where the edges of three faces stay";
}

TEST(PairContraction, LockedBoundaryAndSubsetMoveNothing) {
  const MeshReport locked = analyze(decimate(plate(10), {.faces = 0, .lockBoundary = true, .pairDistance = 0.01}));
  EXPECT_EQ(locked.boundaryEdges, 40u);
  EXPECT_LE(locked.vertices, 41u);
  EXPECT_FLOAT_EQ(static_cast<float>(locked.area), 1);

  const Mesh two = plates(0.03F);
  std::set<std::array<float, 3>> given;
  for (const Vec3f& p : two.positions) given.insert({p.x, p.y, p.z});
  DecimateReport report;
  const Mesh fewer =
      decimate(two, {.faces = 20, .placement = CollapsePlacement::kSubset, .pairDistance = 0.031}, &report);
  EXPECT_GT(report.pairs->merges, 0u);
  for (const Vec3f& p : fewer.positions) EXPECT_TRUE(given.contains({p.x, p.y, p.z}));
}

TEST(PairContraction, PropertiesAndNormalsAreCarried) {
  Mesh tips = sphere(12);
  add(tips, sphere(12), {2.01F, 0, 0});
  Buffer<float> x;
  Buffer<std::uint8_t> ball;
  for (const Vec3f& p : tips.positions) {
    x.push_back(p.x);
    ball.push_back(p.x < 1.005F ? 100 : 200);
  }
  tips.properties = {{"x", 1, x}, {"ball", 1, ball}};
  tips.normals = tips.positions;
  DecimateReport report;
  const Mesh fewer = decimate(tips, {.faces = 500, .pairDistance = 0.011}, &report);
  ASSERT_EQ(report.pairs->merges, 1u);
  ASSERT_EQ(fewer.values<float>("x").size(), fewer.positions.size());
  ASSERT_EQ(fewer.normals.size(), fewer.positions.size());
  std::size_t between = 0;
  for (std::size_t v = 0; v < fewer.positions.size(); ++v) {
    const Vec3f& p = fewer.positions[v];
    EXPECT_NEAR(fewer.values<float>("x")[v], p.x, 0.05);
    const int value = fewer.values<std::uint8_t>("ball")[v];
    between += value > 100 && value < 200;
    if (std::abs(p.x - 1.005F) < 0.1F) continue;  // Normals of both balls meet there.
    EXPECT_EQ(value, p.x < 1.005F ? 100 : 200);
    EXPECT_GT(dot(fewer.normals[v], p - Vec3f{p.x < 1.005F ? 0 : 2.01F, 0, 0}), 0.95F);
  }
  EXPECT_EQ(between, 1u) << "what has merged has what lies between";
}

TEST(PairContraction, SameBytesForAnyNumberOfThreadsAndUnit) {
  Mesh tips = sphere(24);
  add(tips, sphere(24), {2.01F, 0.01F, 0});
  test::addNoise(tips, 0.003);
  const DecimateOptions options{.ratio = 0.05, .pairDistance = 0.08};
  const auto with = [&](int threads) { return detail::withThreads(threads, [&] { return decimate(tips, options); }); };
  const Mesh one = with(1);
  for (const int threads : {2, 3, 8}) EXPECT_TRUE(sameBytes(with(threads), one)) << threads;
  for (const float scale : {0x1p-10F, 0x1p10F}) {
    Mesh scaled = tips, expected = one;
    for (Vec3f& p : scaled.positions) p *= scale;
    for (Vec3f& p : expected.positions) p *= scale;
    const Mesh result = decimate(scaled, {.ratio = 0.05, .pairDistance = 0.08 * double{scale}});
    EXPECT_TRUE(sameBytes(result, expected)) << scale;
  }
}

TEST(PairContraction, MovedMeshGivesTheMovedResult) {
  Mesh two = plates(0x1p-5F);
  for (Vec3f& p : two.positions)
    for (int i = 0; i < 3; ++i) p[i] = std::round(p[i] * 0x1p12F) * 0x1p-12F;  // So that moving rounds nothing.
  Mesh moved = two;
  const Vec3f by{1024, -512, 256};
  for (Vec3f& p : moved.positions) p += by;
  const DecimateOptions options{.faces = 200, .pairDistance = 0.04};
  const Mesh fewer = decimate(two, options), movedFewer = decimate(moved, options);
  ASSERT_EQ(fewer.triangles, movedFewer.triangles);
  for (std::size_t v = 0; v < fewer.positions.size(); ++v)
    EXPECT_LT(length(vecCast<double>(fewer.positions[v] + by - movedFewer.positions[v])), 2e-4);
}

TEST(PairContraction, RefusesWhatIsOutOfRange) {
  const Mesh mesh = plate(2);
  const auto refuses = [&](const DecimateOptions& options) {
    EXPECT_THROW(static_cast<void>(decimate(mesh, options)), std::invalid_argument);
  };
  refuses({.faces = 1, .pairDistance = 0});
  refuses({.faces = 1, .pairDistance = -1});
  refuses({.faces = 1, .pairDistance = std::numeric_limits<double>::infinity()});
  refuses({.faces = 1, .pairDistance = std::numeric_limits<double>::quiet_NaN()});
  refuses({.faces = 1, .sound = true, .pairDistance = 1});
  refuses({.faces = 1, .error = 1, .pairDistance = 1});
  refuses({.faces = 1, .memory = 0.5, .pairDistance = 1});
  EXPECT_THROW(static_cast<void>(decimate(plate(30), {.faces = 1, .pairDistance = 10})), Error) << "too many pairs";
  EXPECT_TRUE(decimate({}, {.faces = 0, .pairDistance = 1}).positions.empty());
}

TEST(PairContraction, StopsWhenAsked) {
  std::atomic<bool> stop{false};
  std::atomic<int> calls{0};
  const auto progress = [&](const char*, double) {
    ++calls;
    stop = true;
  };
  const DecimateOptions options{.faces = 100, .pairDistance = 0.01};
  const Monitor monitor{.progress = progress, .stop = &stop};
  EXPECT_THROW(static_cast<void>(decimate(sphere(40), options, nullptr, monitor)), Cancelled);
  EXPECT_EQ(calls, 1) << "nothing was done after it";
}

TEST(PairContraction, NoFaceTurnsFarther) {
  DecimateReport report;
  const Mesh ball = sphere(8);
  EXPECT_GT(decimate(ball, {.faces = 0, .maxTurn = 5, .pairDistance = 0.01}, &report).triangles.size(), 100u);
  EXPECT_EQ(report.end, DecimateEnd::kNoCollapseLeft);
  EXPECT_LT(decimate(ball, {.faces = 0, .maxTurn = 90, .pairDistance = 0.01}).triangles.size(), 20u);
}

// What was an edge is none any more when its faces are gone.
TEST(PairContraction, EdgesThatAreGoneJoinNothing) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0.1F, 0}, {2, 0, 0}, {3, 1, 0}, {3, -1, 0}, {-1, -1, 0}, {-1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {2, 4, 3}, {0, 6, 5}};
  DecimateReport report;
  const Mesh two = decimate(mesh, {.faces = 0, .pairDistance = 0.01}, &report);
  EXPECT_EQ(two.triangles.size(), 2u);
  EXPECT_EQ(report.pairs->merges, 0u);
  EXPECT_EQ(report.pairs->componentsAfter, 2u);
}

}  // namespace
}  // namespace pdc
