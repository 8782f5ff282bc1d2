#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "parallel/with_threads.h"
#include "pdc/error.h"
#include "pdc/mesh/mesh_comparison.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/simplify/decimate.h"
#include "simplify/shapes.h"

namespace pdc {
namespace {

/// The largest distance measured between two surfaces, either way.
double measured(const Mesh& a, const Mesh& b) {
  const MeshComparison c = compareMeshes(a, b, {.samples = 100'000});
  return std::max(c.toReference.largest, c.fromReference.largest);
}

Mesh noisy(Mesh mesh, float size) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal(0, size);
  for (Vec3f& p : mesh.positions) p = p + Vec3f{normal(random), normal(random), normal(random)};
  return mesh;
}

/// A part that is open and whose sheets lie close to each other: a cylinder's wall of a fifth of its radius, cut.
Mesh pipe(int n) {
  Mesh mesh = test::plate(n);
  for (Vec3f& p : mesh.positions) {
    const float side = p.y < 0.5F ? 2 * p.y : 2 - 2 * p.y, angle = 6 * p.x, radius = p.y < 0.5F ? 1.0F : 0.8F;
    p = {radius * std::cos(angle), radius * std::sin(angle), side};
  }
  return mesh;
}

/// Closed, of n faces around the tip and as many around the middle of the base.
Mesh cone(std::uint32_t n) {
  Mesh mesh;
  mesh.positions = {{0, 0, 100}, {0, 0, 0}};
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    mesh.positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
    const std::uint32_t at = 2 + i, next = 2 + (i + 1) % n;
    mesh.triangles.push_back({0, at, next});
    mesh.triangles.push_back({1, next, at});
  }
  return mesh;
}

struct ErrorCase {
  std::string name;
  Mesh mesh;
};

class DecimateError : public testing::TestWithParam<int> {};

ErrorCase caseOf(int i) {
  switch (i) {
    case 0:
      return {"sphere", test::sphere(16)};
    case 1:
      return {"torus", test::torus(32)};
    case 2:
      return {"cube", test::cube(12)};
    case 3:
      return {"plate", test::plate(24)};
    case 4:
      return {"noise", noisy(test::sphere(16), 0.02F)};
    case 5:
      return {"rough", noisy(test::sphere(12), 0.1F)};
    case 6:
      return {"rough_plate", noisy(test::plate(24), 0.02F)};
    default:
      return {"pipe", pipe(32)};
  }
}

TEST_P(DecimateError, HoldsBothWays) {
  const Mesh mesh = caseOf(GetParam()).mesh;
  std::size_t before = mesh.triangles.size() + 1;
  for (const double error : {0.02, 0.1, 0.5, 2.0}) {
    DecimateReport report;
    const Mesh fewer = decimate(mesh, {.error = MeshLength{error, true}}, &report);
    EXPECT_NEAR(report.error, error * report.meanEdge, 1e-12 * report.error);
    EXPECT_LE(measured(fewer, mesh), report.error * (1 + 1e-5)) << error;
    EXPECT_LE(fewer.triangles.size(), before) << error;
    EXPECT_EQ(analyze(fewer).eulerNumber, analyze(mesh).eulerNumber);
    before = fewer.triangles.size();
  }
  EXPECT_LT(before, mesh.triangles.size() / 4);
}

INSTANTIATE_TEST_SUITE_P(Shapes, DecimateError, testing::Range(0, 8),
                         [](const auto& shape) { return caseOf(shape.param).name; });

TEST(DecimateErrorBound, LetsFlatPartsGo) {
  EXPECT_EQ(decimate(test::cube(12), {.error = 1e-3}).triangles.size(), 12u);
  EXPECT_EQ(decimate(test::plate(24), {.error = 1e-3}).triangles.size(), 2u);
}

TEST(DecimateErrorBound, IsUsedWell) {
  // A regular polyhedron about the sphere with error e has about 4 pi / (sqrt(3) e) triangles, with vertices as far
  // outside as faces are inside.
  const Mesh ball = test::sphere(40);
  const double error = 0.02;
  const Mesh fewer = decimate(ball, {.error = MeshLength{error}});
  EXPECT_LT(static_cast<double>(fewer.triangles.size()), 1.5 * 4 * std::numbers::pi / (std::sqrt(3.0) * error));
}

// Each edge at the tip would be refused in a round of its own, and all others wait.
TEST(DecimateErrorBound, DoesNotWaitForTheEdgesOfAHub) {
  const Mesh tip = cone(2000);
  DecimateReport report;
  const Mesh fewer = decimate(tip, {.error = 0.01}, &report);
  EXPECT_LT(report.rounds, 1000u);
  EXPECT_LT(fewer.triangles.size(), 100u);
  EXPECT_EQ(analyze(fewer).eulerNumber, 2);
  EXPECT_LE(measured(fewer, tip), 0.01 * (1 + 1e-5));
}

TEST(DecimateErrorBound, EndsAtTheFirstTargetThatIsMet) {
  const Mesh ball = test::sphere(16);
  DecimateReport report;
  EXPECT_EQ(decimate(ball, {.faces = 2000, .error = 0.5}, &report).triangles.size(), 2000u);
  EXPECT_EQ(report.end, DecimateEnd::kReached);
  EXPECT_GT(decimate(ball, {.faces = 100, .error = 0.001}, &report).triangles.size(), 100u);
  EXPECT_EQ(report.end, DecimateEnd::kError);
  EXPECT_GT(report.refusedErrors, 0u);
}

TEST(DecimateErrorBound, HoldsTogetherWithSoundness) {
  // Two balls, one in the other, so close that they come to intersect if nothing is done about it.
  Mesh balls = test::sphere(12);
  const auto size = static_cast<std::uint32_t>(balls.positions.size());
  for (std::uint32_t v = 0; v < size; ++v) balls.positions.push_back(balls.positions[v] * 0.96F);
  for (const auto& [a, b, c] : test::sphere(12).triangles) balls.triangles.push_back({a + size, b + size, c + size});
  const MeshLength error{0.1};
  EXPECT_GT(selfIntersections(decimate(balls, {.error = error})).pairs.size(), 0u);
  DecimateReport report;
  const Mesh fewer = decimate(balls, {.error = error, .sound = true}, &report);
  EXPECT_EQ(selfIntersections(fewer).pairs.size(), 0u);
  EXPECT_GT(report.refusedIntersections, 0u);
  EXPECT_LE(measured(fewer, balls), error.value * (1 + 1e-5));
}

TEST(DecimateErrorBound, IsMultipliedByWhatVerticesHave) {
  Mesh ball = test::sphere(24);
  Buffer<float> scale;
  for (const Vec3f& p : ball.positions) scale.push_back(p.z < 0 ? 0.05F : 1.0F);
  ball.properties.push_back({"scale", 1, scale});
  const double error = 0.05;
  for (const bool sound : {false, true}) {
    DecimateOptions options{.error = error, .sound = sound};
    const std::size_t coarse = decimate(ball, options).triangles.size();
    options.errorScale = "scale";
    const Mesh fewer = decimate(ball, options);
    Mesh lower = ball;
    lower.triangles.clear();
    for (const Triangle& t : ball.triangles)
      if (std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return scale[v] < 1; })) lower.triangles.push_back(t);
    EXPECT_LE(compareMeshes(lower, fewer, {.samples = 100'000}).toReference.largest, 0.05 * error * (1 + 1e-5));
    EXPECT_LE(measured(fewer, ball), error * (1 + 1e-5));
    EXPECT_GT(fewer.triangles.size(), 2 * coarse);
    EXPECT_EQ(fewer.values<float>("scale").size(), fewer.positions.size());
  }
}

TEST(DecimateErrorBound, RefusesScalesThatAreNone) {
  Mesh ball = test::sphere(4);
  Buffer<double> scale(ball.positions.size(), 1);
  const auto refusal = [&](double value) {
    scale[7] = value;
    ball.properties = {{"scale", 1, scale}, {"vector", 2, Buffer<float>(2 * scale.size(), 1)}};
    try {
      (void)decimate(ball, {.error = 0.1, .errorScale = "scale"});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(refusal(2), "none");
  for (const double bad : {-0.5, std::nan(""), HUGE_VAL})
    EXPECT_NE(refusal(bad).find("the property 'scale' of vertex 7 is "), std::string::npos) << refusal(bad);
  EXPECT_THROW((void)decimate(ball, {.error = 0.1, .errorScale = "vector"}), Error);
  EXPECT_THROW((void)decimate(ball, {.error = 0.1, .errorScale = "missing"}), Error);
  EXPECT_THROW((void)decimate(ball, {.faces = 8, .errorScale = "scale"}), std::invalid_argument);
}

TEST(DecimateErrorBound, IsTheSameForAnyNumberOfThreadsAndUnit) {
  const Mesh rough = noisy(test::torus(32), 0.02F);
  Mesh larger = rough;
  for (Vec3f& p : larger.positions) p *= 1024;
  const DecimateOptions options{.error = MeshLength{0.3, true}};
  const Mesh one = detail::withThreads(1, [&] { return decimate(rough, options); });
  const Mesh scaled = decimate(larger, options);
  EXPECT_EQ(one.triangles, scaled.triangles);
  for (std::size_t v = 0; v < one.positions.size(); ++v) EXPECT_EQ(one.positions[v] * 1024.0F, scaled.positions[v]);
  for (const int threads : {2, 3, 8}) {
    const Mesh other = detail::withThreads(threads, [&] { return decimate(rough, options); });
    EXPECT_EQ(one.triangles, other.triangles);
    EXPECT_EQ(one.positions, other.positions);
  }
}

TEST(DecimateErrorBound, RefusesWhatIsNoLength) {
  for (const double error : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW((void)decimate(test::sphere(2), {.error = MeshLength{error}}), std::invalid_argument) << error;
}

}  // namespace
}  // namespace pdc
