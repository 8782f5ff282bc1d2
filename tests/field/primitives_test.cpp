#include "pdc/field/primitives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "field/field_checks.h"

namespace pdc {
namespace {

using test::FieldCase;
using test::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const Vec3d kFrom{-1.3, 0.4, -0.7}, kTo{0.9, 1.1, 1.6}, kCenter{0.3, -0.2, 0.5}, kHalf{1.1, 0.6, 1.7};
const Box kRegion{{-4, -4, -4}, {4, 4, 4}};

std::vector<FieldCase> primitives() {
  return {
      {"sphere", sphere(kCenter, 1.4), true},
      {"farSphere", sphere({1e6, -1e6, 1e6}, 2), true, 1, {{1e6 - 4, -1e6 - 4, 1e6 - 4}, {1e6 + 4, -1e6 + 4, 1e6 + 4}}},
      {"hugeSphere", sphere({1e4, 0, 0}, 1e4), true},
      {"box", box(kCenter, kHalf), true},
      {"roundedBox", roundedBox(kCenter, kHalf, 0.4), true},
      {"roundestBox", roundedBox(kCenter, kHalf, 0.6), true},
      {"plane", plane(kCenter, {1, -2, 0.5}), true},
      {"farPlane", plane({1e3, 2e3, 0}, {1, -2, 0.5}), true},
      {"cylinder", cylinder(kFrom, kTo, 0.8), true},
      {"disc", cylinder({0, 0, -0.1}, {0, 0, 0.1}, 2), true},
      {"cappedCone", cappedCone(kFrom, kTo, 1.5, 0.4), true},
      {"wideningCone", cappedCone(kFrom, kTo, 0.2, 2.5), true},
      {"pointedCone", cappedCone(kFrom, kTo, 1.2, 0), true},
      {"straightCone", cappedCone(kFrom, kTo, 0.8, 0.8), true},
      {"torus", torus(kCenter, {1, 2, -1}, 1.7, 0.5), true},
      {"capsule", capsule(kFrom, kTo, 0.7), true},
      {"ellipsoid", ellipsoid(kCenter, {1.5, 0.8, 1.1}), false, 3, {{1, 0, 1}, {4, 4, 4}}},
      {"gyroid", gyroid(2.5, 0)},
      {"gyroidSheet", gyroid(2.5, 0.3)}};
}

class Primitives : public testing::TestWithParam<FieldCase> {};

TEST_P(Primitives, GradientsMatchDifferences) { test::expectGradientsMatchDifferences(GetParam()); }
TEST_P(Primitives, BoundsHold) { test::expectBoundsHold(GetParam()); }
TEST_P(Primitives, BoundsConverge) { test::expectBoundsConverge(GetParam()); }
TEST_P(Primitives, BatchesAgree) { test::expectBatchesAgree(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, Primitives, testing::ValuesIn(primitives()), testing::PrintToStringParamName());

/// Position along the segment from kFrom (0) to kTo (1), and distance from its line.
struct OnSegment {
  double t, away;

  explicit OnSegment(const Vec3d& p) {
    const Vec3d d = kTo - kFrom;
    t = dot(p - kFrom, d) / dot(d, d);
    away = length(cross(p - kFrom, d)) / length(d);
  }
};

struct Solid {
  std::string name;
  FieldPtr field;
  std::function<bool(const Vec3d&)> inside;
};

std::ostream& operator<<(std::ostream& out, const Solid& solid) { return out << solid.name; }

bool insideCone(const Vec3d& p, double from, double to) {
  const OnSegment s(p);
  return s.t > 0 && s.t < 1 && s.away < from + (to - from) * s.t;
}

bool insideRoundedBox(const Vec3d& p, double radius) {
  const Vec3d d = p - kCenter;
  Vec3d nearest;
  for (int i = 0; i < 3; ++i) nearest[i] = std::clamp(d[i], radius - kHalf[i], kHalf[i] - radius);
  return length(d - nearest) < radius;
}

bool insideTorus(const Vec3d& p) {
  const Vec3d axis = Vec3d{1, 2, -1} * (1 / std::sqrt(6.0)), d = p - kCenter;
  return std::hypot(length(cross(d, axis)) - 1.7, dot(d, axis)) < 0.5;
}

std::vector<Solid> solids() {
  return {
      {"sphere", sphere(kCenter, 1.4), [](const Vec3d& p) { return length(p - kCenter) < 1.4; }},
      {"box", box(kCenter, kHalf),
       [](const Vec3d& p) {
         const Vec3d d = p - kCenter;
         return std::abs(d.x) < kHalf.x && std::abs(d.y) < kHalf.y && std::abs(d.z) < kHalf.z;
       }},
      {"roundedBox", roundedBox(kCenter, kHalf, 0.4), [](const Vec3d& p) { return insideRoundedBox(p, 0.4); }},
      {"plane", plane(kCenter, {1, -2, 0.5}),
       [](const Vec3d& p) {
         return dot(p - kCenter, {1, -2, 0.5}) < 0;
       }},
      {"cylinder", cylinder(kFrom, kTo, 0.8), [](const Vec3d& p) { return insideCone(p, 0.8, 0.8); }},
      {"cappedCone", cappedCone(kFrom, kTo, 1.5, 0.4), [](const Vec3d& p) { return insideCone(p, 1.5, 0.4); }},
      {"wideningCone", cappedCone(kFrom, kTo, 0.2, 2.5), [](const Vec3d& p) { return insideCone(p, 0.2, 2.5); }},
      {"pointedCone", cappedCone(kFrom, kTo, 1.2, 0), [](const Vec3d& p) { return insideCone(p, 1.2, 0); }},
      {"torus", torus(kCenter, {1, 2, -1}, 1.7, 0.5), insideTorus},
      {"capsule", capsule(kFrom, kTo, 0.7),
       [](const Vec3d& p) {
         const double t = std::clamp(OnSegment(p).t, 0.0, 1.0);
         return length(p - kFrom - (kTo - kFrom) * t) < 0.7;
       }},
  };
}

class ExactDistances : public testing::TestWithParam<Solid> {};

// Three facts that leave no other value: the sign is right, some point of the surface is as near as the value says, and
// none is nearer, because no two values differ by more than the distance between their points.
TEST_P(ExactDistances, AreSignedDistancesToTheSurface) {
  const auto& [name, field, inside] = GetParam();
  Random random(5);
  int insides = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3d p = random.in(kRegion), q = random.in(kRegion);
    const double value = field->valueAt(p);
    ASSERT_EQ(value < 0, inside(p));
    insides += value < 0 ? 1 : 0;
    ASSERT_LE(std::abs(field->valueAt(q) - value), length(p - q) * (1 + 1e-12));
    ASSERT_NEAR(field->valueAt(p - field->gradientAt(p) * value), 0, 1e-12);
  }
  EXPECT_GT(insides, 20);
}

INSTANTIATE_TEST_SUITE_P(All, ExactDistances, testing::ValuesIn(solids()), testing::PrintToStringParamName());

TEST(Primitives, KnownDistances) {
  EXPECT_EQ(sphere({1, 2, 3}, 2)->valueAt({1, 2, 8}), 3);
  EXPECT_EQ(box({0, 0, 0}, {1, 2, 3})->valueAt({0, 0, 0}), -1);
  EXPECT_EQ(box({0, 0, 0}, {1, 2, 3})->valueAt({4, 6, 3}), 5);
  EXPECT_EQ(roundedBox({0, 0, 0}, {1, 2, 3}, 0.5)->valueAt({0, 0, 5}), 2);
  EXPECT_EQ(plane({0, 0, 1}, {0, 0, 7})->valueAt({3, 4, 5}), 4);
  EXPECT_EQ(cylinder({0, 0, -1}, {0, 0, 1}, 2)->valueAt({5, 0, 5}), 5);
  EXPECT_EQ(cappedCone({0, 0, -1}, {0, 0, 1}, 2, 1)->valueAt({0, 0.5, 3}), 2);
  EXPECT_EQ(torus({0, 0, 0}, {0, 0, 1}, 3, 1)->valueAt({0, 0, 4}), 4);
  EXPECT_EQ(capsule({-1, 0, 0}, {1, 0, 0}, 0.5)->valueAt({4, 4, 0}), 4.5);
}

TEST(Primitives, GradientsPointOutwardsAtCreases) {
  const auto unit = box({0, 0, 0}, {1, 1, 1});
  const Vec3d onEdge = unit->gradientAt({1, 1, 0});
  EXPECT_TRUE(onEdge == (Vec3d{1, 0, 0}) || onEdge == (Vec3d{0, 1, 0}));
  EXPECT_EQ(cylinder({0, 0, -1}, {0, 0, 1}, 1)->gradientAt({0, 0, -1}), (Vec3d{0, 0, -1}));
  EXPECT_EQ(cappedCone({0, 0, 0}, {0, 0, 2}, 1, 0)->gradientAt({0, 0, 3}), (Vec3d{0, 0, 1}));
}

// Where a distance has no gradient there must still be a value, and a gradient that is finite.
TEST(Primitives, AreFiniteOnTheirAxes) {
  const Vec3d up{0, 0, 1}, down{0, 0, -1}, origin{0, 0, 0};
  const std::pair<FieldPtr, double> cases[] = {{sphere(origin, 2), -2},          {box(origin, {1, 2, 3}), -1},
                                               {cylinder(down, up, 0.5), -0.5},  {cylinder(down, up, 3), -1},
                                               {cappedCone(down, up, 3, 3), -1}, {torus(origin, up, 3, 1), 2},
                                               {capsule(down, up, 0.5), -0.5},   {ellipsoid(origin, {3, 1, 2}), -1}};
  for (const auto& [field, expected] : cases) {
    EXPECT_EQ(field->valueAt(origin), expected);
    const Vec3d g = field->gradientAt(origin);
    EXPECT_TRUE(std::isfinite(g.x) && std::isfinite(g.y) && std::isfinite(g.z));
    EXPECT_TRUE(field->bound({down, up}).contains(expected));
  }
  EXPECT_EQ(torus(origin, up, 3, 1)->valueAt({3, 0, 0}), -1);
}

// These bounds are attained, so a tighter one does not exist.
TEST(Primitives, BoundsOfSpheresBoxesAndPlanesAreExact) {
  Random random(6);
  for (const FieldPtr& field :
       {sphere(kCenter, 1.4), box(kCenter, kHalf), roundedBox(kCenter, kHalf, 0.4), plane(kCenter, {1, -2, 0.5})}) {
    for (int i = 0; i < 20; ++i) {
      const Box where = random.boxIn(kRegion, 0.1, 2);
      const Interval bound = field->bound(where);
      Interval seen{kInfinity, -kInfinity};
      constexpr int kSteps = 24;
      const Vec3d step = (where.hi - where.lo) * (1.0 / kSteps);
      for (int x = 0; x <= kSteps; ++x)
        for (int y = 0; y <= kSteps; ++y)
          for (int z = 0; z <= kSteps; ++z) {
            const double v = field->valueAt(where.lo + Vec3d{step.x * x, step.y * y, step.z * z});
            seen = {std::min(seen.lo, v), std::max(seen.hi, v)};
          }
      EXPECT_NEAR(bound.lo, seen.lo, length(step));
      EXPECT_NEAR(bound.hi, seen.hi, 1e-10);
    }
  }
}

TEST(Primitives, BoundsHoldFarFromTheOrigin) {
  test::expectBoundsHold({"sphere", sphere({1e8, 0, 0}, 1e8)});
  test::expectBoundsHold({"plane", plane({1e8, 2e8, 0}, {1, -2, 0.5})});
  test::expectBoundsHold({"cone", cappedCone({-1e8, 0, 1}, {1e8, 0, 2}, 3, 1)});
}

TEST(Primitives, EllipsoidHasTheRightZeroSetAndNormals) {
  const Vec3d axes{1.5, 0.8, 1.1};
  const auto field = ellipsoid(kCenter, axes);
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const double z = random.in(-1, 1), phi = random.in(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    const Vec3d u{r * std::cos(phi), r * std::sin(phi), z};
    const Vec3d p = kCenter + Vec3d{u.x * axes.x, u.y * axes.y, u.z * axes.z};
    const Vec3d normal{u.x / axes.x, u.y / axes.y, u.z / axes.z};
    EXPECT_NEAR(field->valueAt(p), 0, 1e-14);
    EXPECT_NEAR(length(field->gradientAt(p) - normal * (1 / length(normal))), 0, 1e-13);
  }
}

TEST(Primitives, EllipsoidWithEqualAxesIsASphere) {
  Random random(8);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random.in(kRegion);
    EXPECT_NEAR(ellipsoid(kCenter, {1.4, 1.4, 1.4})->valueAt(p), sphere(kCenter, 1.4)->valueAt(p), 1e-13);
  }
}

TEST(Primitives, GyroidHasItsSymmetriesAndScale) {
  const double period = 2.5;
  const auto field = gyroid(period, 0), sheet = gyroid(period, 0.3);
  Random random(9);
  const double scale = period / (2 * std::numbers::pi * std::sqrt(3.0));
  double steepest = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3d p = random.in(kRegion);
    const double value = field->valueAt(p);
    EXPECT_NEAR(field->valueAt(p + Vec3d{period, -2 * period, 3 * period}), value, 1e-13);
    EXPECT_NEAR(field->valueAt({p.y, p.z, p.x}), value, 1e-14);
    EXPECT_NEAR(field->valueAt(-p), -value, 1e-14);
    EXPECT_NEAR(sheet->valueAt(p), std::abs(value) - 0.3 * scale, 1e-14);
    steepest = std::max(steepest, length(field->gradientAt(p)));
  }
  EXPECT_LE(steepest, 1 + 1e-12);
  EXPECT_GT(steepest, 0.99);
}

TEST(Primitives, RefuseBadArguments) {
  const Vec3d o{0, 0, 0}, x{1, 0, 0}, bad{0, kNan, 0};
  for (const double size : {0.0, -1.0, kNan, kInfinity}) {
    EXPECT_THROW(sphere(o, size), std::invalid_argument);
    EXPECT_THROW(box(o, {1, size, 1}), std::invalid_argument);
    EXPECT_THROW(roundedBox(o, {1, 1, size}, 0.1), std::invalid_argument);
    EXPECT_THROW(roundedBox(o, {1, 1, 1}, size), std::invalid_argument);
    EXPECT_THROW(cylinder(o, x, size), std::invalid_argument);
    EXPECT_THROW(torus(o, x, size, 1), std::invalid_argument);
    EXPECT_THROW(torus(o, x, 1, size), std::invalid_argument);
    EXPECT_THROW(capsule(o, x, size), std::invalid_argument);
    EXPECT_THROW(ellipsoid(o, {size, 1, 1}), std::invalid_argument);
    EXPECT_THROW(gyroid(size, 0), std::invalid_argument);
  }
  EXPECT_THROW(roundedBox(o, {1, 2, 3}, 1.01), std::invalid_argument);
  EXPECT_THROW(cappedCone(o, x, 0, 0), std::invalid_argument);
  EXPECT_THROW(cappedCone(o, x, -1, 2), std::invalid_argument);
  EXPECT_THROW(cappedCone(o, x, 1, kInfinity), std::invalid_argument);
  EXPECT_THROW(gyroid(1, -0.1), std::invalid_argument);
  EXPECT_THROW(gyroid(1, kInfinity), std::invalid_argument);
  EXPECT_THROW(sphere(bad, 1), std::invalid_argument);
  EXPECT_THROW(box(bad, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(roundedBox(bad, {1, 1, 1}, 0.1), std::invalid_argument);
  EXPECT_THROW(plane(bad, x), std::invalid_argument);
  EXPECT_THROW(plane(o, bad), std::invalid_argument);
  EXPECT_THROW(plane(o, o), std::invalid_argument);
  EXPECT_THROW(cylinder(x, x, 1), std::invalid_argument);
  EXPECT_THROW(cappedCone(x, x, 1, 1), std::invalid_argument);
  EXPECT_THROW(cylinder(bad, x, 1), std::invalid_argument);
  EXPECT_THROW(cappedCone(x, bad, 1, 1), std::invalid_argument);
  EXPECT_THROW(capsule(x, bad, 1), std::invalid_argument);
  EXPECT_THROW(capsule(x, x, 1), std::invalid_argument);
  EXPECT_THROW(torus(bad, x, 2, 1), std::invalid_argument);
  EXPECT_THROW(torus(o, o, 2, 1), std::invalid_argument);
  EXPECT_THROW(ellipsoid(bad, {1, 1, 1}), std::invalid_argument);
  try {
    sphere(o, -1);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "sphere radius must be positive and finite, not -1");
  }
}

}  // namespace
}  // namespace pdc
