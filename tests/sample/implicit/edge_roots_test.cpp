#include "sample/implicit/edge_roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "sample/implicit/counting_field.h"

namespace pdc::detail {
namespace {

constexpr double kTolerance = 0x1p-20;

struct Outcome {
  double worstError = 0;   ///< Distance of t from the change of side, in edges.
  double evaluations = 0;  ///< Per edge.
};

/// Roots of f(s - root) along one edge, for `count` seeded roots in (0, 1).
Outcome findRoots(const std::function<double(double)>& f, std::size_t count = EdgeBatch::kCapacity) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> root(0.001, 0.999);
  EdgeBatch edges;
  std::array<double, EdgeBatch::kCapacity> roots, t;
  edges.size = count;
  for (std::size_t i = 0; i < count; ++i) {
    roots[i] = root(random);
    edges.low[0][i] = 0;
    edges.low[1][i] = roots[i];
    edges.low[2][i] = 0;
    edges.axis[i] = 0;
  }
  const test::CountingField field([&](const Vec3d& p) { return f(p.x - p.y); }, [](const Vec3d&) { return Vec3d{}; },
                                  test::unknownBound);
  findEdgeRoots(field, {{0, 0, 0}, 1}, edges, t.data());
  Outcome outcome{0, static_cast<double>(field.points()) / static_cast<double>(count)};
  for (std::size_t i = 0; i < count; ++i) outcome.worstError = std::max(outcome.worstError, std::abs(t[i] - roots[i]));
  return outcome;
}

TEST(EdgeRoots, LinearFunctionsAreExactInFewEvaluations) {
  const Outcome up = findRoots([](double s) { return 3 * s; });
  EXPECT_LE(up.worstError, 1e-14);
  EXPECT_LE(up.evaluations, 5);
  const Outcome down = findRoots([](double s) { return -1e-8 * s; });
  EXPECT_LE(down.worstError, 1e-14);
  EXPECT_LE(down.evaluations, 5);
}

TEST(EdgeRoots, SmoothFunctionsTakeFewEvaluations) {
  const Outcome quadratic = findRoots([](double s) { return s + 0.3 * s * s; });
  EXPECT_LE(quadratic.worstError, 1e-9);
  EXPECT_LE(quadratic.evaluations, 7);
  const Outcome exponential = findRoots([](double s) { return std::expm1(2 * s); });
  EXPECT_LE(exponential.worstError, 1e-9);
  EXPECT_LE(exponential.evaluations, 9);
}

TEST(EdgeRoots, BracketHoldsForSteepFlatAndBrokenFunctions) {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const std::function<double(double)> functions[] = {
      [](double s) { return s * s * s; },
      [](double s) { return std::pow(s, 9); },
      [](double s) { return std::tanh(1e6 * s); },
      [](double s) { return std::cbrt(s); },
      [](double s) { return s < 0 ? -1.0 : 1.0; },
      [](double s) { return s < 0 ? -1e300 : 1e-300; },
      [](double s) { return s < 0 ? 1e-5 : -1e5; },
      [](double s) { return 1 / s; },
      [](double s) { return s < 0 ? s : 0.0; },
      [=](double s) { return s < 0 ? -1.0 : nan; },
      [=](double s) { return s < 0 ? nan : -s - 1e-3; },
      [=](double s) { return s < 0 ? -infinity : infinity; },
      [](double s) { return s < 0 ? std::exp(-50 * s) - 1 : -std::numeric_limits<double>::denorm_min(); },
  };
  for (const auto& f : functions) {
    const Outcome outcome = findRoots(f);
    EXPECT_LE(outcome.worstError, kTolerance) << "function " << &f - functions;
    EXPECT_LE(outcome.evaluations, 62) << "function " << &f - functions;
  }
}

/// The roots of the two edges along y that meet at y = 0.
std::array<double, 2> rootsAboutZero(const std::function<double(const Vec3d&)>& f) {
  EdgeBatch edges;
  edges.size = 2;
  for (auto& low : edges.low) low[0] = low[1] = 0;
  edges.low[1][1] = -1;
  edges.axis[0] = edges.axis[1] = 1;
  const test::CountingField field(
      f, [](const Vec3d&) { return Vec3d{}; }, test::unknownBound);
  std::array<double, 2> t;
  findEdgeRoots(field, {{5, 0, 5}, 0.25}, edges, t.data());
  return t;
}

TEST(EdgeRoots, RootAtAnEndIsThatEnd) {
  // The zero is outside, then inside.
  EXPECT_EQ(rootsAboutZero([](const Vec3d& p) { return 0.0 - std::abs(p.y); }), (std::array<double, 2>{0, 1}));
  EXPECT_EQ(rootsAboutZero([](const Vec3d& p) { return p.y == 0 ? -0.0 : std::abs(p.y); }),
            (std::array<double, 2>{0, 1}));
}

TEST(EdgeRoots, AmongZerosTheSignTells) {
  const double at = 0.07;
  const auto t = rootsAboutZero([=](const Vec3d& p) { return std::abs(p.y) < at ? -0.0 : 0.0; });
  EXPECT_NEAR(t[0], at / 0.25, 2e-6);
  EXPECT_NEAR(t[1], 1 - at / 0.25, 2e-6);
}

TEST(EdgeRoots, DoNotDependOnTheBatch) {
  const auto f = [](const Vec3d& p) { return std::expm1(p.x - 0.1 - 0.7 * p.y) + (p.y > 0.5 ? 3 : 0.1) * (p.x - 0.5); };
  const test::CountingField field(
      f, [](const Vec3d&) { return Vec3d{}; }, test::unknownBound);
  EdgeBatch edges;
  edges.size = EdgeBatch::kCapacity;
  for (std::size_t i = 0; i < edges.size; ++i) {
    edges.low[0][i] = edges.low[2][i] = 0;
    edges.low[1][i] = static_cast<double>(i) / EdgeBatch::kCapacity;
    edges.axis[i] = 0;
  }
  std::array<double, EdgeBatch::kCapacity> together;
  findEdgeRoots(field, {{0, 0, 0}, 1}, edges, together.data());
  for (std::size_t i = 0; i < edges.size; ++i) {
    EdgeBatch single;
    single.size = 1;
    for (int axis = 0; axis < 3; ++axis) single.low[axis][0] = edges.low[axis][i];
    single.axis[0] = edges.axis[i];
    double alone;
    findEdgeRoots(field, {{0, 0, 0}, 1}, single, &alone);
    EXPECT_EQ(alone, together[i]);
  }
}

}  // namespace
}  // namespace pdc::detail
