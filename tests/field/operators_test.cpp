#include "pdc/field/operators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "field/field_checks.h"
#include "pdc/field/formula.h"
#include "pdc/field/noise.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

using test::FieldCase;
using test::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const Box kRegion{{-4, -4, -4}, {4, 4, 4}};
const FieldPtr kBall = sphere({0.4, 0.1, -0.3}, 1.5);
const FieldPtr kBrick = box({-0.5, 0.3, 0.2}, {1.2, 0.9, 1.6});
const FieldPtr kCentered = roundedBox({0, 0, 0}, {1.2, 0.9, 0.5}, 0.2);
const FieldPtr kCellsAboutEdge = torus({0.2, 0, 0.1}, {1, 1, 2}, 1.6, 0.4);

/// A field that is turned again and again, with something between the turns that keeps them from merging.
FieldPtr nestedRotations(FieldPtr field, int depth) {
  for (int i = 0; i < depth; ++i)
    field = unite({rotate(std::move(field), {1, 2, 3}, 37), plane({0, 0, -9}, {0, 0, 1})});
  return field;
}

std::vector<FieldCase> operators() {
  return {{"unite", unite({kBall, kBrick, kCellsAboutEdge}), true},
          {"uniteOne", unite({kBall}), true},
          {"intersect", intersect({kBall, kBrick, complement(kCellsAboutEdge)}), true},
          {"subtract", subtract({kBall, kBrick, kCellsAboutEdge}), true},
          {"smoothUnite", smoothUnite({kBall, kBrick, kCellsAboutEdge}, 0.4)},
          {"smoothIntersect", smoothIntersect({kBall, kBrick, complement(kCellsAboutEdge)}, 0.4)},
          {"smoothSubtract", smoothSubtract({kBall, kBrick, kCellsAboutEdge}, 0.4)},
          {"complement", complement(kBrick), true},
          {"offset", offset(kBrick, 0.3), true},
          {"inset", offset(kBall, -0.3), true},
          {"shell", shell(kBrick, 0.2), true},
          {"translate", translate(kBrick, {1, -0.4, 0.7}), true},
          {"rotate", rotate(kBrick, {1, -2, 0.5}, 77), true},
          {"rotateRightAngle", rotate(kBrick, {0, 1, 0}, 90), true},
          {"scale", scale(kBrick, 1.7), true},
          {"scaleUnevenly", scale(kBrick, Vec3d{1.7, 0.6, 0.9})},
          {"placed",
           scale(rotate(translate(rotate(kCellsAboutEdge, {1, 0, 3}, 50), {1, -0.5, 0}), {0, 1, 1}, -20), 0.8), true},
          {"sheared", rotate(scale(rotate(kBrick, {1, 2, 3}, 40), Vec3d{1.5, 1, 0.5}), {1, 0, 0}, 30)},
          {"nestedRotations", nestedRotations(kBrick, 8), true},
          {"mirror", mirror(translate(kBall, {1.5, 0, 0}), 0), true},
          {"repeat", repeat(kCentered, {4, 5, 4.5}, {0, 0, 0}), true},
          {"repeatOneAxis", repeat(kCentered, {0, 0, 1.3}, {0, 0, 0})},
          {"repeatCounted", repeat(kCentered, {3, 2.2, 0}, {1, 2, 0}), true},
          {"tree",
           smoothUnite(
               {rotate(subtract({kBall, offset(kBrick, -0.2)}), {1, 1, 1}, 33), shell(mirror(kCellsAboutEdge, 1), 0.3),
                scale(simplexNoise({.seed = 3, .octaves = 2, .amplitude = 0.05}), 0.5)},
               0.2),
           false, 2}};
}

class Operators : public testing::TestWithParam<FieldCase> {};

TEST_P(Operators, GradientsMatchDifferences) { test::expectGradientsMatchDifferences(GetParam()); }
TEST_P(Operators, BoundsHold) { test::expectBoundsHold(GetParam()); }
TEST_P(Operators, BoundsConverge) { test::expectBoundsConverge(GetParam()); }
TEST_P(Operators, BatchesAgree) { test::expectBatchesAgree(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, Operators, testing::ValuesIn(operators()), testing::PrintToStringParamName());

/// Expects the same function: values and gradients differ by no more than `tolerance` anywhere.
void expectEqual(const FieldPtr& a, const FieldPtr& b, double tolerance = 0) {
  Random random(10);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random.in(kRegion);
    ASSERT_NEAR(a->valueAt(p), b->valueAt(p), tolerance);
    ASSERT_LE(length(a->gradientAt(p) - b->gradientAt(p)), tolerance);
  }
}

TEST(Operators, ObeyTheAlgebraOfSets) {
  expectEqual(complement(complement(kBall)), kBall);
  expectEqual(complement(unite({kBall, kBrick})), intersect({complement(kBall), complement(kBrick)}));
  expectEqual(complement(smoothUnite({kBall, kBrick}, 0.5)),
              smoothIntersect({complement(kBall), complement(kBrick)}, 0.5));
  expectEqual(subtract({kBall, kBrick, kCellsAboutEdge}),
              intersect({kBall, complement(kBrick), complement(kCellsAboutEdge)}));
  expectEqual(smoothSubtract({kBall, kBrick}, 0.5), smoothIntersect({kBall, complement(kBrick)}, 0.5));
  expectEqual(unite({kBall, kBrick, kCellsAboutEdge}), unite({kCellsAboutEdge, kBall, kBrick}));
  expectEqual(unite({kBall, kBall}), kBall);
  expectEqual(offset(offset(kBall, 0.25), -0.25), kBall, 1e-15);
}

TEST(Operators, ValuesAreThoseOfTheFormulas) {
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random.in(kRegion);
    const double a = kBall->valueAt(p), b = kBrick->valueAt(p), k = 0.7;
    const double h = std::max(0.0, k - std::abs(a - b));
    EXPECT_EQ(unite({kBall, kBrick})->valueAt(p), std::min(a, b));
    EXPECT_EQ(intersect({kBall, kBrick})->valueAt(p), std::max(a, b));
    EXPECT_EQ(subtract({kBall, kBrick})->valueAt(p), std::max(a, -b));
    EXPECT_NEAR(smoothUnite({kBall, kBrick}, k)->valueAt(p), std::min(a, b) - h * h / (4 * k), 1e-15);
    EXPECT_NEAR(smoothIntersect({kBall, kBrick}, k)->valueAt(p), std::max(a, b) + h * h / (4 * k), 1e-15);
    EXPECT_EQ(offset(kBall, 0.3)->valueAt(p), a - 0.3);
    EXPECT_EQ(shell(kBall, 0.5)->valueAt(p), std::abs(a) - 0.25);
  }
}

TEST(Operators, SharpGradientsAreThoseOfTheActiveOperand) {
  const auto corner = intersect({plane({0, 0, 0}, {1, 0, 0}), plane({0, 0, 0}, {0, 1, 0})});
  EXPECT_EQ(corner->gradientAt({2, 1, 0}), (Vec3d{1, 0, 0}));
  EXPECT_EQ(corner->gradientAt({1, 2, 0}), (Vec3d{0, 1, 0}));
  EXPECT_EQ(length(shell(kBall, 0.2)->gradientAt({1.9, 0.1, -0.3})), 1);
}

TEST(Operators, SharpGradientsOfEqualOperandsAreTheFirstOnes) {
  const FieldPtr x = plane({0, 0, 0}, {1, 0, 0}), y = plane({0, 0, 0}, {0, 1, 0}), behind = complement(y);
  const Vec3d tie{1, 1, 0};
  for (const auto& make : {unite, intersect}) {
    EXPECT_EQ(make({x, y})->gradientAt(tie), (Vec3d{1, 0, 0}));
    EXPECT_EQ(make({y, x})->gradientAt(tie), (Vec3d{0, 1, 0}));
  }
  EXPECT_EQ(subtract({x, behind})->gradientAt(tie), (Vec3d{1, 0, 0}));
}

// A plane's fillet in the corner of two others starts where it should.
TEST(Operators, FilletsEndAtTheRadius) {
  const FieldPtr x = plane({0, 0, 0}, {1, 0, 0}), y = plane({0, 0, 0}, {0, 1, 0});
  const auto groove = smoothUnite({x, y}, 0.5);
  EXPECT_EQ(groove->valueAt({0, 0.5, 0}), 0);
  EXPECT_LT(groove->valueAt({0, 0.49, 0}), 0);
  EXPECT_EQ(groove->valueAt({0, 0, 0}), -0.125);
  EXPECT_EQ(groove->gradientAt({0, 0, 0}), (Vec3d{0.5, 0.5, 0}));
}

TEST(Operators, NanIsOutsideOfTheOperandThatHasIt) {
  const FieldPtr half = formula("sqrt(x)-2", 1), everywhere = sphere({0, 0, 0}, 3);
  const Vec3d p{-1, 0, 0};
  ASSERT_TRUE(std::isnan(half->valueAt(p)));
  const double value = everywhere->valueAt(p);
  for (const auto& operands : {std::vector{half, everywhere}, std::vector{everywhere, half}}) {
    EXPECT_EQ(unite(operands)->valueAt(p), value);
    EXPECT_EQ(smoothUnite(operands, 0.5)->valueAt(p), value);
    EXPECT_EQ(unite(operands)->gradientAt(p), everywhere->gradientAt(p));
    EXPECT_TRUE(std::isnan(intersect(operands)->valueAt(p)));
    EXPECT_TRUE(std::isnan(smoothIntersect(operands, 0.5)->valueAt(p)));
  }
  EXPECT_EQ(subtract({everywhere, half})->valueAt(p), value);
  EXPECT_TRUE(std::isnan(subtract({half, everywhere})->valueAt(p)));
}

TEST(Operators, PlacementMovesSpheres) {
  const Vec3d center{0.4, 0.1, -0.3};
  expectEqual(translate(kBall, {1, 2, -0.5}), sphere(center + Vec3d{1, 2, -0.5}, 1.5), 1e-14);
  expectEqual(scale(kBall, 2), sphere(center * 2, 3), 1e-14);
  expectEqual(rotate(kBall, {0, 0, 5}, 90), sphere({-0.1, 0.4, -0.3}, 1.5), 1e-14);
  expectEqual(rotate(kBall, {1, 2, 3}, 25), sphere(rotation({1, 2, 3}, 25) * center, 1.5), 1e-14);
  expectEqual(mirror(sphere({1, 0, 0}, 0.5), 0), unite({sphere({1, 0, 0}, 0.5), sphere({-1, 0, 0}, 0.5)}), 1e-14);
}

TEST(Operators, PlacementsCompose) {
  expectEqual(translate(translate(kBrick, {1, 2, 3}), {0.5, -1, 0}), translate(kBrick, {1.5, 1, 3}), 1e-14);
  expectEqual(rotate(rotate(kBrick, {1, 1, 0}, 30), {1, 1, 0}, 15), rotate(kBrick, {1, 1, 0}, 45), 1e-13);
  expectEqual(rotate(rotate(kBrick, {1, 2, 3}, 70), {1, 2, 3}, -70), kBrick, 1e-13);
  expectEqual(scale(scale(kBrick, 2), Vec3d{1, 3, 0.5}), scale(kBrick, Vec3d{2, 6, 1}), 1e-14);
  // Operators apply from the inside out, so order matters.
  expectEqual(rotate(translate(kBall, {1, 0, 0}), {0, 0, 1}, 90), translate(rotate(kBall, {0, 0, 1}, 90), {0, 1, 0}),
              1e-14);
}

TEST(Operators, UnevenScaleKeepsTheZeroSetAndNeverOverestimates) {
  const FieldPtr egg = scale(sphere({0, 0, 0}, 1), Vec3d{1.5, 0.8, 1.1});
  EXPECT_NEAR(egg->valueAt({1.5, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(egg->valueAt({0, 0.8, 0}), 0, 1e-15);
  EXPECT_NEAR(egg->valueAt({0, 0, -1.1}), 0, 1e-15);
  EXPECT_LE(egg->lipschitz(), 1 + 1e-15);
}

TEST(Operators, RotationIsRightHandedAndExactForRightAngles) {
  const Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_EQ(rotation(z, 90) * x, y);
  EXPECT_EQ(rotation(x * 7, 90) * y, z);
  EXPECT_EQ(rotation(y, -270) * z, x);
  EXPECT_EQ(rotation(z, 180) * x, -x);
  EXPECT_EQ(rotation(z, 720 + 90) * x, y);
  EXPECT_NEAR((rotation(z, 30) * x).y, 0.5, 1e-15);
  const Mat3d r = rotation({1, -2, 3}, 123);
  EXPECT_NEAR(r.determinant(), 1, 1e-15);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(dot(r.row[i], r.row[j]), i == j, 1e-15);
}

TEST(Operators, BoundsOfNestedRotationsDoNotGrow) {
  const Box where{{1, 1, 1}, {2, 2, 2}};
  const Interval once = nestedRotations(kBrick, 1)->bound(where), often = nestedRotations(kBrick, 12)->bound(where);
  EXPECT_LE(once.hi - once.lo, 2 * where.radius() + 1e-9);
  EXPECT_LE(often.hi - often.lo, 2 * where.radius() + 1e-9);
}

TEST(Operators, RepeatIsTheUnionOfItsCopies) {
  const FieldPtr original = sphere({0.1, -0.2, 0.1}, 0.5);
  std::vector<FieldPtr> copies;
  for (int i = -2; i <= 2; ++i)
    for (int j = -1; j <= 1; ++j) copies.push_back(translate(original, {i * 1.5, j * 2.0, 0}));
  const FieldPtr repeated = repeat(original, {1.5, 2, 0}, {2, 1, 0}), united = unite(copies);
  Random random(12);
  for (int i = 0; i < 5000; ++i) {
    const Vec3d p = random.in(kRegion);
    EXPECT_EQ(repeated->valueAt(p) < 0, united->valueAt(p) < 0);
    EXPECT_GE(repeated->valueAt(p), united->valueAt(p) - 1e-14);
  }
  EXPECT_EQ(repeated->valueAt({30, 0, 0}), original->valueAt({27, 0, 0}));
  EXPECT_EQ(repeat(original, {1.5, 2, 0}, {0, 0, 0})->valueAt({30, 0, 0}), original->valueAt({0, 0, 0}));
}

// Off the middle of its cell the copies do not fit together, and the function jumps from one to the next.
TEST(Operators, BoundsOfRepeatHoldWhereItJumps) {
  test::expectBoundsHold({"all", repeat(kBall, {2, 2.3, 2.9}, {0, 0, 0})});
  test::expectBoundsHold({"some", repeat(kBrick, {1, 2.3, 0}, {2, 1, 0})});
}

TEST(Operators, BoundsOfRepeatAreThoseOfOneCopy) {
  const FieldPtr original = sphere({0, 0, 0}, 0.5), repeated = repeat(original, {2, 2, 2}, {0, 0, 0});
  const Box within{{-0.25, -0.25, -0.25}, {0.5, 0.5, 0.5}}, moved{{3.75, 5.75, -2.25}, {4.5, 6.5, -1.5}};
  EXPECT_EQ(repeated->bound(moved).lo, original->bound(within).lo);
  EXPECT_EQ(repeated->bound(moved).hi, original->bound(within).hi);
  const Interval all = repeated->bound({{-100, -100, -100}, {100, 100, 100}});
  EXPECT_NEAR(all.lo, -0.5, 1e-9);
  EXPECT_NEAR(all.hi, std::sqrt(3.0) - 0.5, 1e-9);
}

TEST(Operators, LipschitzConstants) {
  EXPECT_EQ(unite({kBall, simplexNoise({.octaves = 1, .amplitude = 3})})->lipschitz(),
            simplexNoise({.octaves = 1, .amplitude = 3})->lipschitz());
  EXPECT_EQ(shell(rotate(kBall, {1, 2, 3}, 4), 0.1)->lipschitz(), 1);
  EXPECT_EQ(scale(kBall, 3)->lipschitz(), 1);
  EXPECT_EQ(repeat(kBall, {1, 1, 1}, {0, 0, 0})->lipschitz(), kInfinity);
}

TEST(Operators, RefuseBadArguments) {
  const FieldPtr null;
  const Vec3d o{0, 0, 0}, x{1, 0, 0}, bad{1, kNan, 1};
  for (const auto& operands : {std::vector<FieldPtr>{}, {null}, {kBall, null}}) {
    EXPECT_THROW(unite(operands), std::invalid_argument);
    EXPECT_THROW(intersect(operands), std::invalid_argument);
    EXPECT_THROW(subtract(operands), std::invalid_argument);
    EXPECT_THROW(smoothUnite(operands, 1), std::invalid_argument);
    EXPECT_THROW(smoothIntersect(operands, 1), std::invalid_argument);
    EXPECT_THROW(smoothSubtract(operands, 1), std::invalid_argument);
  }
  for (const double size : {0.0, -1.0, kNan, kInfinity}) {
    EXPECT_THROW(smoothUnite({kBall}, size), std::invalid_argument);
    EXPECT_THROW(smoothIntersect({kBall}, size), std::invalid_argument);
    EXPECT_THROW(smoothSubtract({kBall}, size), std::invalid_argument);
    EXPECT_THROW(shell(kBall, size), std::invalid_argument);
    EXPECT_THROW(scale(kBall, size), std::invalid_argument);
    EXPECT_THROW(scale(kBall, Vec3d{1, size, 1}), std::invalid_argument);
  }
  EXPECT_THROW(complement(null), std::invalid_argument);
  EXPECT_THROW(offset(null, 1), std::invalid_argument);
  EXPECT_THROW(offset(kBall, kInfinity), std::invalid_argument);
  EXPECT_THROW(offset(kBall, kNan), std::invalid_argument);
  EXPECT_THROW(shell(null, 1), std::invalid_argument);
  EXPECT_THROW(translate(null, o), std::invalid_argument);
  EXPECT_THROW(translate(kBall, bad), std::invalid_argument);
  EXPECT_THROW(rotation(o, 10), std::invalid_argument);
  EXPECT_THROW(rotation(x, kNan), std::invalid_argument);
  EXPECT_THROW(rotate(null, x, 10), std::invalid_argument);
  EXPECT_THROW(rotate(kBall, bad, 10), std::invalid_argument);
  EXPECT_THROW(scale(null, 1), std::invalid_argument);
  EXPECT_THROW(mirror(null, 0), std::invalid_argument);
  EXPECT_THROW(mirror(kBall, -1), std::invalid_argument);
  EXPECT_THROW(mirror(kBall, 3), std::invalid_argument);
  EXPECT_THROW(repeat(null, x, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(repeat(kBall, {-1, 0, 0}, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(repeat(kBall, bad, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(repeat(kBall, {kInfinity, 0, 0}, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(repeat(kBall, x, {0, -1, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace pdc
