#include "pdc/smooth/smooth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "parallel/with_threads.h"
#include "pdc/math/solvers.h"
#include "pdc/math/triangle_quadric.h"
#include "pdc/mesh/mesh_report.h"
#include "simplify/same_bytes.h"
#include "simplify/shapes.h"

namespace pdc {
namespace {

using test::cube, test::plate, test::sameBytes, test::sphere;

Mesh noisy(Mesh mesh, double sigma) {
  test::addNoise(mesh, sigma);
  return mesh;
}

/// Root mean square distance of a mesh's vertices from the unit sphere.
double offSphere(const Mesh& mesh) {
  double sum = 0;
  for (const Vec3f& p : mesh.positions) sum += std::pow(length(vecCast<double>(p)) - 1, 2);
  return std::sqrt(sum / static_cast<double>(mesh.positions.size()));
}

/// And from the boundary of [-1, 1]³.
double offCube(const Mesh& mesh) {
  double sum = 0;
  for (const Vec3f& p : mesh.positions) sum += std::pow(double{largestEntry(p)} - 1, 2);
  return std::sqrt(sum / static_cast<double>(mesh.positions.size()));
}

double largestMove(const Mesh& a, const Mesh& b) {
  double most = 0;
  for (std::size_t v = 0; v < a.positions.size(); ++v)
    most = std::max(most, double{length(a.positions[v] - b.positions[v])});
  return most;
}

TEST(Smooth, NoiseOfASphereGoes) {
  const double edge = 0.06;  // Of sphere(30), about.
  const Mesh ball = noisy(sphere(30), 0.2 * edge);
  SmoothReport report;
  const Mesh result = smooth(ball, {.sigma = 0.2}, &report);
  EXPECT_LT(offSphere(result), 0.5 * offSphere(ball));
  EXPECT_EQ(result.triangles, ball.triangles);
  EXPECT_EQ(report.vertices, 5402u);
  EXPECT_EQ(report.triangles, 10800u);
  EXPECT_NEAR(report.meanSigma, 0.2, 1e-12);
  EXPECT_GT(report.meanMove, 0.1);
  EXPECT_LE(report.meanMove, report.largestMove);
}

TEST(Smooth, NoiseOfACubeGoesAndItsEdgesStay) {
  const double edge = 0.12;  // Of cube(20), about.
  const Mesh box = noisy(cube(20), 0.1 * edge);
  const Mesh result = smooth(box, {.sigma = 0.1});
  EXPECT_LT(offCube(result), 0.55 * offCube(box));
  // The eight corners come first along each axis' sides; a Laplacian step would draw them in by half an edge.
  for (const Vec3f& p : result.positions)
    if (std::min({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 0.98F) {
      EXPECT_GT(length(p), std::sqrt(3.0F) * 0.97F);
    }
}

TEST(Smooth, WithoutAveragingEachVertexGoesToTheMinimumOfItsFaces) {
  const Mesh ball = noisy(sphere(6), 0.02);
  SmoothReport report;
  const Mesh result = smooth(ball, {.iterations = 0, .sigma = 0.3}, &report);
  for (std::uint32_t v = 0; v < 20; ++v) {
    NormalEquations<double> sum = NormalEquations<double>::zero();
    for (const Triangle& t : ball.triangles) {
      if (std::find(t.begin(), t.end(), v) == t.end()) continue;
      const auto at = [&](int k) { return vecCast<double>(ball.positions[t[k]]); };
      sum += probabilisticTriangleQuadric(at(0), at(1), at(2), 0.3 * report.meanEdge).normalEquations();
    }
    // With noise of 0.3 beside the hundredth to which the minimum is known a vertex goes nearly all of the way.
    const Vec3d given = vecCast<double>(ball.positions[v]), step = *solveLdlt(sum.A, sum.b) - given;
    const Vec3d expected = given + step * (0.09 / (0.09 + 1e-4));
    EXPECT_LT(length(expected - vecCast<double>(result.positions[v])), 1e-6) << v;
  }
}

TEST(Smooth, NothingMovesWithoutNoise) {
  for (const Mesh& mesh : {plate(8), cube(8), noisy(sphere(8), 0.02)})
    EXPECT_TRUE(sameBytes(smooth(mesh, {.sigma = 0}), mesh));
}

/// The mean place along y of the lowest row of plate(20), and how far its vertices are from that.
std::array<double, 2> lowestRow(const Mesh& mesh) {
  double mean = 0, spread = 0;
  for (std::size_t v = 1; v < 20; ++v) mean += mesh.positions[v].y / 19;
  for (std::size_t v = 1; v < 20; ++v) spread += std::pow(mesh.positions[v].y - mean, 2) / 19;
  return {mean, std::sqrt(spread)};
}

TEST(Smooth, BoundariesAreSmoothedAndDoNotShrink) {
  const Mesh flat = plate(20), rough = noisy(flat, 0.005);
  EXPECT_LT(lowestRow(smooth(flat, {.sigma = 0.2}))[0], 1e-3) << "a sixtieth of an edge";
  EXPECT_NEAR(analyze(smooth(flat, {.sigma = 0.2})).area, 1, 0.0075);
  const auto [mean, spread] = lowestRow(rough);
  const auto [smoothMean, smoothSpread] = lowestRow(smooth(rough, {.iterations = 10, .sigma = 0.1}));
  EXPECT_NEAR(smoothMean, mean, 1e-3);
  EXPECT_LT(smoothSpread, 0.75 * spread);

  const Mesh locked = smooth(rough, {.sigma = 0.05, .lockBoundary = true});
  for (std::size_t v = 0; v < 21; ++v) EXPECT_EQ(locked.positions[v], rough.positions[v]);
  EXPECT_NE(locked.positions[30], rough.positions[30]);
}

TEST(Smooth, SigmaOfAPropertyDecidesWhereItIsSmoothed) {
  Mesh ball = noisy(sphere(20), 0.01);
  Buffer<float> sigma;
  for (const Vec3f& p : ball.positions) sigma.push_back(p.x > 0 ? 0.02F : 0);
  ball.properties = {{"sigma", 1, sigma}};
  const Mesh result = smooth(ball, {.sigmaProperty = "sigma"});
  std::size_t moved = 0;
  for (std::size_t v = 0; v < ball.positions.size(); ++v) {
    if (ball.positions[v].x <= 0) {
      EXPECT_EQ(result.positions[v], ball.positions[v]) << v;
    }
    moved += result.positions[v] != ball.positions[v];
  }
  EXPECT_GT(moved, ball.positions.size() / 3);
  // What contouring says of clean creases, in a mesh of edges of a twelfth.
  std::get<Buffer<float>>(ball.properties[0].values).assign(ball.positions.size(), 0.0015F);
  EXPECT_TRUE(sameBytes(smooth(ball, {.sigmaProperty = "sigma"}), ball));
  ball.properties = {{"sigma", 1, sigma}};
  EXPECT_EQ(result.properties, ball.properties);
}

TEST(Smooth, FacesOfOneSizeCountAlike) {
  Mesh mesh = noisy(sphere(12), 0.01);
  for (Vec3f& p : mesh.positions) p.x *= 1 + p.y * p.y;
  const Mesh plain = smooth(mesh, {}), normalised = smooth(mesh, {.normaliseArea = true});
  EXPECT_GT(largestMove(plain, normalised), 1e-3);
  EXPECT_LT(largestMove(plain, normalised), 0.3);
}

TEST(Smooth, SameBytesForAnyNumberOfThreads) {
  for (const Mesh& mesh : {noisy(sphere(40), 0.003), noisy(plate(60), 0.002)}) {
    const auto with = [&](int threads) { return detail::withThreads(threads, [&] { return smooth(mesh, {}); }); };
    const Mesh one = with(1);
    EXPECT_FALSE(sameBytes(one, mesh));
    for (const int threads : {2, 3, 8}) EXPECT_TRUE(sameBytes(with(threads), one)) << threads;
  }
}

TEST(Smooth, UnitOfLengthDoesNotMatter) {
  const Mesh ball = noisy(sphere(16), 0.01);
  const Mesh result = smooth(ball, {});
  for (const float scale : {0x1p-30F, 0x1p20F}) {
    Mesh scaled = ball, expected = result;
    for (Vec3f& p : scaled.positions) p *= scale;
    for (Vec3f& p : expected.positions) p *= scale;
    EXPECT_TRUE(sameBytes(smooth(scaled, {}), expected)) << scale;
  }
}

TEST(Smooth, PlaceDoesNotMatter) {
  // Multiples of 2^-12 stay what they are a thousand units away.
  Mesh near = noisy(sphere(16), 0.01);
  for (Vec3f& p : near.positions)
    for (int i = 0; i < 3; ++i) p[i] = std::round(p[i] * 4096) / 4096;
  Mesh far = near;
  const Vec3f offset{1000, -1000, 500};
  for (Vec3f& p : far.positions) p += offset;
  const Mesh a = smooth(near, {}), b = smooth(far, {});
  for (std::size_t v = 0; v < a.positions.size(); ++v)
    EXPECT_LT(length(b.positions[v] - offset - a.positions[v]), 1e-4F) << v;
}

TEST(Smooth, QuadsAndNormalsStayTheirs) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5F, 0.5F, 1}, {9, 9, 9}};
  mesh.quads = {{0, 3, 2, 1}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  mesh.normals.resize(6, Vec3f{0, 0, 1});
  const Mesh result = smooth(mesh, {.sigma = 0.1});
  EXPECT_EQ(result.quads, mesh.quads);
  EXPECT_EQ(result.positions[5], mesh.positions[5]) << "without a face it stays";
  EXPECT_LT(result.normals[0].z, 0) << "made anew";
  EXPECT_NEAR(length(result.normals[0]), 1, 1e-6);
}

TEST(Smooth, NothingFliesAway) {
  // Beside large triangles the minima of small ones lie far away.
  Mesh mesh = plate(12);
  for (Vec3f& p : mesh.positions) p = {p.x * p.x * p.x * p.x, p.y * p.y * p.y * p.y, p.x * p.y};
  std::vector<float> longest(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const float edge = length(mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]);
      for (const std::uint32_t v : {t[k], t[(k + 1) % 3]}) longest[v] = std::max(longest[v], edge);
    }
  for (const double sigma : {0.02, 0.3, 1e30}) {
    SmoothReport report;
    const Mesh result = smooth(mesh, {.sigma = sigma}, &report);
    EXPECT_GT(report.limitedMoves, 0u);
    for (std::size_t v = 0; v < longest.size(); ++v)
      EXPECT_LE(length(result.positions[v] - mesh.positions[v]),
                1.0001 * std::min(double{longest[v]}, 8 * sigma * report.meanEdge))
          << v << ' ' << sigma;
  }
}

TEST(Smooth, TrianglesWithoutAreaGiveNoNan) {
  Mesh mesh = plate(4);
  for (std::size_t v = 5; v < 10; ++v) mesh.positions[v] = mesh.positions[v - 5];
  for (const bool normalise : {false, true})
    for (const double sigma : {1e-9, 0.1})
      for (const Vec3f& p : smooth(mesh, {.sigma = sigma, .normaliseArea = normalise}).positions)
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
}

TEST(Smooth, RefusesBadRequests) {
  const Mesh ball = sphere(2);
  EXPECT_THROW((void)smooth(ball, {.iterations = -1}), std::invalid_argument);
  EXPECT_THROW((void)smooth(ball, {.iterations = 1001}), std::invalid_argument);
  EXPECT_THROW((void)smooth(ball, {.sigma = -0.1}), std::invalid_argument);
  EXPECT_THROW((void)smooth(ball, {.sigma = std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  EXPECT_THROW((void)smooth(ball, {.sigmaProperty = "none"}), Error);
  EXPECT_THROW((void)smooth({}, {}), Error);
  const std::atomic<bool> stop = true;
  EXPECT_THROW((void)smooth(ball, {}, nullptr, {.stop = &stop}), Cancelled);
}

TEST(Smooth, StopsAndReportsProgress) {
  const Mesh ball = sphere(40);
  std::atomic<bool> stop = false;
  std::atomic<int> calls = 0;
  const auto stopAtOnce = [&](const char*, double) {
    ++calls;
    stop = true;
  };
  EXPECT_THROW((void)smooth(ball, {}, nullptr, {.progress = stopAtOnce, .stop = &stop}), Cancelled);
  EXPECT_LE(calls, 10);
  std::atomic<double> last = 0;
  const auto note = [&](const char*, double share) {
    double seen = last;
    while (share > seen && !last.compare_exchange_weak(seen, share)) {
    }
  };
  (void)smooth(ball, {}, nullptr, {.progress = note});
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace pdc
