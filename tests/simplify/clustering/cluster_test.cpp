#include "pdc/simplify/cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <stdexcept>

#include "mesh/faces.h"
#include "parallel/with_threads.h"
#include "simplify/quadric_kinds.h"
#include "simplify/same_bytes.h"
#include "simplify/shapes.h"

namespace pdc {
namespace {

using test::cube, test::plate, test::sphere, test::sameBytes;

using Cell = std::array<int, 3>;

Cell cellOf(const Vec3f& p, double cell) {
  Cell result{};
  for (int axis = 0; axis < 3; ++axis)
    result[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(double(p[axis]) / cell));
  return result;
}

/// How far a point is from the centre of a cell, along the axis where that is most, in cells.
double fromCenter(const Vec3f& p, const Cell& c, double cell) {
  return largestEntry(vecCast<double>(p) * (1 / cell) - Vec3d{c[0] + 0.5, c[1] + 0.5, c[2] + 0.5});
}

std::vector<std::array<Vec3f, 3>> cornersOf(const Mesh& mesh) {
  std::vector<std::array<Vec3f, 3>> all;
  for (const Triangle& t : mesh.triangles) all.push_back(detail::corners(mesh, t));
  return all;
}

/// What clustering makes of a mesh, face by face, without places; and the cell of each vertex.
struct Expected {
  Buffer<Triangle> triangles;
  std::vector<Cell> cells;

  Expected(const Mesh& mesh, double cell) {
    std::map<Cell, std::uint32_t> numbers;
    std::vector<Cell> all;
    Buffer<Triangle> faces;
    for (const std::array<Vec3f, 3>& t : cornersOf(mesh)) {
      Triangle face{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [it, isNew] = numbers.try_emplace(cellOf(t[k], cell), static_cast<std::uint32_t>(all.size()));
        if (isNew) all.push_back(it->first);
        face[k] = it->second;
      }
      if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) faces.push_back(face);
    }
    std::map<std::uint32_t, std::uint32_t> used;
    for (const Triangle& t : faces)
      for (const std::uint32_t c : t) used[c] = 0;
    for (auto& [c, vertex] : used) {
      vertex = static_cast<std::uint32_t>(cells.size());
      cells.push_back(all[c]);
    }
    for (const Triangle& t : faces) triangles.push_back({used[t[0]], used[t[1]], used[t[2]]});
  }
};

TEST(Cluster, FacesAreThoseOfCornersInThreeCellsWithEveryQuadric) {
  Mesh ball = sphere(30);
  test::addNoise(ball, 0.01);
  const Expected expected(ball, 0.17);
  for (const QuadricKind kind : test::kQuadricKinds) {
    ClusterReport report;
    const Mesh fewer = cluster(ball, {.cell = 0.17, .quadric = kind}, &report);
    EXPECT_EQ(fewer.triangles, expected.triangles);
    EXPECT_EQ(fewer.positions.size(), expected.cells.size());
    EXPECT_EQ(report.trianglesBefore, ball.triangles.size());
    EXPECT_EQ(report.trianglesAfter, fewer.triangles.size());
    EXPECT_EQ(report.collapsedTriangles, ball.triangles.size() - fewer.triangles.size());
    EXPECT_EQ(report.vertices, fewer.positions.size());
    EXPECT_GE(report.cells, report.vertices);
  }
}

TEST(Cluster, VerticesStayInTheirCellsUnlessFree) {
  Mesh ball = sphere(30);
  test::addNoise(ball, 0.02);
  const Expected expected(ball, 0.17);
  for (const QuadricKind kind : test::kQuadricKinds) {
    ClusterOptions options{.cell = 0.17, .quadric = kind, .sigmaNormal = 0.001, .sigmaPosition = 0.001};
    ClusterReport report;
    const Mesh inside = cluster(ball, options, &report);
    for (std::size_t v = 0; v < expected.cells.size(); ++v)
      EXPECT_LE(fromCenter(inside.positions[v], expected.cells[v], 0.17), 0.5 + 1e-5);
    options.free = true;
    ClusterReport freeReport;
    const Mesh free = cluster(ball, options, &freeReport);
    EXPECT_EQ(freeReport.outsideVertices, report.outsideVertices);
    EXPECT_EQ(free.triangles, inside.triangles);
    std::size_t outside = 0, moved = 0;
    for (std::size_t v = 0; v < expected.cells.size(); ++v) {
      const double far = fromCenter(free.positions[v], expected.cells[v], 0.17);
      EXPECT_LE(far, 2 + 1e-5);
      outside += far > 0.5 + 1e-5;
      moved += free.positions[v] != inside.positions[v];
    }
    EXPECT_LE(moved, report.outsideVertices) << "vertices inside do not depend on it";
    EXPECT_NEAR(static_cast<double>(outside), static_cast<double>(report.outsideVertices), 2);
    EXPECT_EQ(kind == QuadricKind::kPoint, report.outsideVertices == 0);
  }
}

TEST(Cluster, VerticesOfAPlaneLieOnIt) {
  Mesh tilted = plate(64);
  const Vec3d n = Vec3d{0.3, -0.5, 1} * (1 / length(Vec3d{0.3, -0.5, 1}));
  for (Vec3f& p : tilted.positions) p.z = 0.5F * p.y - 0.3F * p.x;
  for (const QuadricKind kind : test::kQuadricKinds) {
    const Mesh fewer = cluster(tilted, {.cell = 0.11, .quadric = kind});
    EXPECT_GT(fewer.triangles.size(), 50u);
    // Triangles pull to their centroids, which may lie outside of the cell: then noise has a say on its border.
    const double tolerance = kind == QuadricKind::kProbabilisticTriangle ? 1e-3 : 1e-5;
    for (const Vec3f& p : fewer.positions) EXPECT_LT(std::abs(dot(n, vecCast<double>(p))), tolerance * 0.11);
  }
}

TEST(Cluster, ClassicalQuadricsKeepEdgesAndCorners) {
  Mesh box = cube(40);
  constexpr double kCell = 0.13;
  // The sides at an edge then do not have the same share of its cells.
  const Vec3f by{0, 0.0625F, -0.03125F};
  for (Vec3f& p : box.positions) p += by;
  std::map<Cell, std::array<double, 3>> sides;  // The sides that a cell holds corners of; 0 where none.
  for (const Vec3f& p : box.positions)
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(p[axis] - by[axis]) == 1) sides[cellOf(p, kCell)][static_cast<std::size_t>(axis)] = double(p[axis]);
  const Expected expected(box, kCell);
  for (const QuadricKind kind : {QuadricKind::kPlane, QuadricKind::kTriangle}) {
    const Mesh fewer = cluster(box, {.cell = kCell, .quadric = kind});
    std::array<int, 4> found{};
    ASSERT_EQ(fewer.positions.size(), expected.cells.size());
    for (std::size_t v = 0; v < expected.cells.size(); ++v) {
      std::size_t planes = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double side = sides[expected.cells[v]][static_cast<std::size_t>(axis)];
        if (side == 0) continue;
        ++planes;
        EXPECT_NEAR(double(fewer.positions[v][axis]), side, 1e-5 * kCell);
      }
      ++found[planes];
    }
    EXPECT_EQ(found[3], 8);
    EXPECT_GT(found[2], 100);
  }
}

TEST(Cluster, WithoutNoiseProbabilisticQuadricsAreClassical) {
  const Mesh box = cube(16);
  EXPECT_TRUE(sameBytes(cluster(box, {.cell = 0.3, .sigmaNormal = 0}),
                        cluster(box, {.cell = 0.3, .quadric = QuadricKind::kPlane})));
  const Mesh triangles = cluster(box, {.cell = 0.3, .quadric = QuadricKind::kTriangle});
  const Mesh probabilistic =
      cluster(box, {.cell = 0.3, .quadric = QuadricKind::kProbabilisticTriangle, .sigmaPosition = 0});
  ASSERT_EQ(triangles.positions.size(), probabilistic.positions.size());
  for (std::size_t v = 0; v < triangles.positions.size(); ++v)
    EXPECT_LT(length(triangles.positions[v] - probabilistic.positions[v]), 1e-5F);
}

TEST(Cluster, PointsGoToTheMeanOfTheCorners) {
  const Mesh ball = sphere(20);
  constexpr double kCell = 0.23;
  std::map<Cell, std::pair<Vec3d, double>> sums;
  for (const std::array<Vec3f, 3>& t : cornersOf(ball)) {
    const Vec3d p = vecCast<double>(t[0]);
    const double area = length(cross(vecCast<double>(t[1]) - p, vecCast<double>(t[2]) - p));
    for (const Vec3f& corner : t) {
      auto& [sum, weight] = sums[cellOf(corner, kCell)];
      sum += vecCast<double>(corner) * area;
      weight += area;
    }
  }
  const Expected expected(ball, kCell);
  const Mesh fewer = cluster(ball, {.cell = kCell, .quadric = QuadricKind::kPoint});
  // Noise of the normals without bounds makes planes points.
  const Mesh noisy = cluster(ball, {.cell = kCell, .sigmaNormal = 1e6});
  ASSERT_EQ(fewer.positions.size(), expected.cells.size());
  for (std::size_t v = 0; v < expected.cells.size(); ++v) {
    const auto& [sum, weight] = sums[expected.cells[v]];
    EXPECT_LT(length(vecCast<double>(fewer.positions[v]) - sum * (1 / weight)), 1e-6);
    EXPECT_LT(length(fewer.positions[v] - noisy.positions[v]), 1e-6F);
  }
}

TEST(Cluster, StreamInPiecesGivesTheSameBytesForAnyNumberOfThreads) {
  Mesh ball = sphere(24);
  test::addNoise(ball, 0.01);
  const std::vector<std::array<Vec3f, 3>> triangles = cornersOf(ball);
  for (const QuadricKind kind : test::kQuadricKinds) {
    const ClusterOptions options{.cell = 0.2, .quadric = kind};
    const Mesh whole = cluster(ball, options);
    for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{1000}, triangles.size()}) {
      Clustering clustering(options);
      for (std::size_t begin = 0; begin < triangles.size(); begin += piece)
        clustering.add(std::span(triangles).subspan(begin, std::min(piece, triangles.size() - begin)));
      EXPECT_TRUE(sameBytes(clustering.finish(), whole)) << piece;
    }
    for (const int threads : {1, 2, 5})
      EXPECT_TRUE(sameBytes(detail::withThreads(threads, [&] { return cluster(ball, options); }), whole)) << threads;
  }
}

TEST(Cluster, UnitOfLengthDoesNotMatter) {
  Mesh ball = sphere(24);
  test::addNoise(ball, 0.01);
  for (const QuadricKind kind : test::kQuadricKinds) {
    const Mesh fewer = cluster(ball, {.cell = 0.2, .quadric = kind});
    for (const float scale : {0x1p-20F, 0x1p20F}) {
      Mesh scaled = ball, expected = fewer;
      for (Vec3f& p : scaled.positions) p *= scale;
      for (Vec3f& p : expected.positions) p *= scale;
      EXPECT_TRUE(sameBytes(cluster(scaled, {.cell = 0.2 * double(scale), .quadric = kind}), expected)) << scale;
    }
  }
}

TEST(Cluster, FarFromTheOriginNothingIsLost) {
  Mesh ball = sphere(24);
  for (Vec3f& p : ball.positions)
    for (int i = 0; i < 3; ++i) p[i] = std::round(p[i] * 0x1p10F) * 0x1p-10F;  // Moving then rounds nothing.
  Mesh moved = ball;
  const Vec3f by{4096, -8192, 2048};
  for (Vec3f& p : moved.positions) p += by;
  const Mesh fewer = cluster(ball, {.cell = 0.25}), movedFewer = cluster(moved, {.cell = 0.25});
  ASSERT_EQ(fewer.triangles, movedFewer.triangles);
  for (std::size_t v = 0; v < fewer.positions.size(); ++v)
    EXPECT_LT(length(fewer.positions[v] + by - movedFewer.positions[v]), 1e-3F);
  moved.origin = {1e6, 2e6, 3e6};
  const Mesh withOrigin = cluster(moved, {.cell = 0.25});
  EXPECT_TRUE(sameBytes(withOrigin, movedFewer));
  EXPECT_EQ(withOrigin.origin, moved.origin);
}

TEST(Cluster, QuadsStandForTheirTriangles) {
  Mesh triangles = plate(16), quads = triangles;
  quads.triangles.clear();
  for (std::size_t i = 0; i < triangles.triangles.size(); i += 2) {
    const Triangle &t = triangles.triangles[i], &u = triangles.triangles[i + 1];
    quads.quads.push_back({t[0], t[1], t[2], u[2]});
  }
  EXPECT_TRUE(sameBytes(cluster(quads, {.cell = 0.2}), cluster(triangles, {.cell = 0.2})));
}

TEST(Cluster, CleanDropsFoldedAndDuplicateFaces) {
  // Two plates closer to each other than the cells are large fall onto each other, here facing opposite ways.
  Mesh thin = plate(16);
  const auto offset = static_cast<std::uint32_t>(thin.positions.size());
  for (std::uint32_t v = 0; v < offset; ++v) thin.positions.push_back(thin.positions[v] + Vec3f{0, 0, 0.01F});
  for (std::size_t i = 0, size = thin.triangles.size(); i < size; ++i) {
    const Triangle t = thin.triangles[i];
    thin.triangles.push_back({t[0] + offset, t[2] + offset, t[1] + offset});
  }
  ClusterReport report;
  const Mesh both = cluster(thin, {.cell = 0.2}, &report);
  EXPECT_GT(both.triangles.size(), 0u);
  EXPECT_EQ(report.foldedFaces + report.duplicateFaces, 0u);
  const Mesh none = cluster(thin, {.cell = 0.2, .clean = true}, &report);
  EXPECT_TRUE(none.triangles.empty());
  EXPECT_TRUE(none.positions.empty()) << "vertices without faces go too";
  EXPECT_EQ(report.foldedFaces, both.triangles.size());

  Mesh twice = plate(16);
  twice.triangles.insert(twice.triangles.end(), thin.triangles.begin(), thin.triangles.begin() + 512);
  const Mesh once = cluster(twice, {.cell = 0.2, .clean = true}, &report);
  EXPECT_EQ(once.triangles, cluster(plate(16), {.cell = 0.2}).triangles);
  EXPECT_EQ(report.duplicateFaces, once.triangles.size());
}

TEST(Cluster, TrianglesThatAreNotFiniteAreLeftOut) {
  const Mesh ball = sphere(10);
  Mesh broken = ball;
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    broken.positions.push_back({0, bad, 0});
    broken.triangles.insert(broken.triangles.begin(), {1, static_cast<std::uint32_t>(broken.positions.size() - 1), 2});
  }
  ClusterReport report;
  EXPECT_TRUE(sameBytes(cluster(broken, {.cell = 0.3}, &report), cluster(ball, {.cell = 0.3})));
  EXPECT_EQ(report.nonFiniteTriangles, 3u);
  EXPECT_EQ(report.trianglesBefore, ball.triangles.size() + 3);
}

TEST(Cluster, TrianglesWithoutAreaCountForFacesOnly) {
  Mesh needle;
  needle.positions = {{0.5F, 0.5F, 0.5F}, {1.25F, 0.5F, 0.5F}, {2.75F, 0.5F, 0.5F}};
  needle.triangles = {{0, 1, 2}, {0, 0, 1}};
  for (const QuadricKind kind : test::kQuadricKinds) {
    ClusterReport report;
    const Mesh mesh = cluster(needle, {.cell = 1, .quadric = kind}, &report);
    EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}}));
    EXPECT_EQ(report.collapsedTriangles, 1u);
    if (kind != QuadricKind::kProbabilisticTriangle) {
      EXPECT_EQ(mesh.positions, needle.positions);
    }
  }
  const Mesh ball = sphere(10);
  Mesh withPoints = ball;
  for (std::uint32_t v = 0; v < ball.positions.size(); ++v) withPoints.triangles.push_back({v, v, v});
  for (const QuadricKind kind : {QuadricKind::kProbabilisticPlane, QuadricKind::kPoint}) {
    const ClusterOptions options{.cell = 0.3, .quadric = kind};
    EXPECT_TRUE(sameBytes(cluster(withPoints, options), cluster(ball, options)));
  }
  EXPECT_TRUE(cluster({}, {.cell = 1}).positions.empty());
  EXPECT_TRUE(cluster(plate(4), {.cell = 10}).positions.empty());
}

TEST(Cluster, RefusesWhatItCannotDo) {
  const Mesh mesh = plate(2);
  const auto refuses = [&](const ClusterOptions& options) {
    EXPECT_THROW(static_cast<void>(cluster(mesh, options)), std::invalid_argument);
    EXPECT_THROW(Clustering{options}, std::invalid_argument);
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  refuses({});
  for (const double cell : {-1.0, kNan, kInf, 1e-310}) refuses({.cell = cell});
  for (const double sigma : {-0.1, kNan, kInf}) {
    refuses({.cell = 1, .sigmaNormal = sigma});
    refuses({.cell = 1, .sigmaPosition = sigma});
  }
  Mesh broken = mesh;
  broken.triangles.push_back({0, 1, 99});
  EXPECT_THROW(static_cast<void>(cluster(broken, {.cell = 1})), Error);
}

TEST(Cluster, RefusesCornersTooFarAway) {
  Mesh mesh = plate(1);
  const auto refused = [&](double cell) {
    try {
      static_cast<void>(cluster(mesh, {.cell = cell}));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(0x1p-19), "");
  EXPECT_NE(refused(0x1p-20).find("the corner 1, 0, 0 is too far away"), std::string::npos) << refused(0x1p-20);
  for (Vec3f& p : mesh.positions) p.y -= 1;
  EXPECT_EQ(refused(0x1p-19), "");
  for (Vec3f& p : mesh.positions) p.z = 1e30F;
  EXPECT_NE(refused(1).find("1e+30"), std::string::npos) << refused(1);
}

TEST(Cluster, VerticesOfCellsThatReachBeyondSinglePrecisionAreFinite) {
  for (const QuadricKind kind : test::kQuadricKinds)
    for (std::size_t v = 0; v < 8; ++v) {
      Mesh spiked = sphere(4);
      spiked.positions[v].y = std::numeric_limits<float>::max();
      spiked.positions[v + 40].x = std::numeric_limits<float>::lowest();
      const Mesh fewer = cluster(
          spiked, {.cell = 3e38, .quadric = kind, .sigmaNormal = 1e-200, .sigmaPosition = 1e-200, .free = true});
      for (const Vec3f& p : fewer.positions) EXPECT_TRUE(detail::isFinite(p)) << p.x << ' ' << p.y << ' ' << p.z;
    }
}

TEST(Cluster, StopsWhenAsked) {
  std::atomic<bool> stop{false};
  const Monitor monitor{.progress = [&](const char*, double) { stop = true; }, .stop = &stop};
  EXPECT_THROW(static_cast<void>(cluster(sphere(20), {.cell = 0.1}, nullptr, monitor)), Cancelled);
}

// What lies on both sides of a cell's wall falls into one cell.
TEST(Cluster, WeldsFirst) {
  Mesh mesh;
  mesh.positions = {{0.999F, 0.5F, 0.5F}, {2.5F, 0.5F, 0.5F}, {0.5F, 2.5F, 0.5F}, {1.001F, 0.5F, 0.5F}};
  mesh.triangles = {{0, 1, 2}, {3, 2, 1}, {0, 3, 1}};
  EXPECT_EQ(cluster(mesh, {.cell = 1}).positions.size(), 4u);
  ClusterReport report;
  EXPECT_EQ(cluster(mesh, {.cell = 1, .weld = 0.01}, &report).positions.size(), 3u);
  EXPECT_EQ(report.weldedVertices, 1u);
  EXPECT_EQ(report.trianglesBefore, 3u);
  EXPECT_EQ(report.collapsedTriangles, 1u);
  EXPECT_THROW(static_cast<void>(cluster(mesh, {.cell = 1, .weld = -1})), std::invalid_argument);
  EXPECT_THROW(Clustering({.cell = 1, .weld = 0.01}), std::invalid_argument);
}

}  // namespace
}  // namespace pdc
