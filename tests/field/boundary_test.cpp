#include "field/boundary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "pdc/field/formula.h"
#include "pdc/field/function_field.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Expects exactly -0.0 or +0.0, from values() and from gradients(), alone and in a batch.
void expectZero(const FieldPtr& field, const Vec3d& p, bool inside) {
  const std::vector<double> x(20, p.x), y(20, p.y), z(20, p.z);
  for (const std::size_t size : {std::size_t{1}, x.size()}) {
    std::vector<double> values(size, 1), same(size, 1), gx(size), gy(size), gz(size);
    const PointSpan points{x.data(), y.data(), z.data(), size};
    field->values(points, values.data());
    field->gradients(points, same.data(), {gx.data(), gy.data(), gz.data()});
    for (std::size_t i = 0; i < size; ++i) {
      EXPECT_EQ(values[i], 0);
      EXPECT_EQ(std::signbit(values[i]), inside);
      EXPECT_EQ(std::signbit(same[i]), inside);
    }
  }
}

TEST(Boundary, InsideIsNegativeOrNegativeZero) {
  EXPECT_TRUE(isInside(-1));
  EXPECT_TRUE(isInside(-0.0));
  EXPECT_FALSE(isInside(0.0));
  EXPECT_FALSE(isInside(1));
  EXPECT_FALSE(isInside(kNan));
  EXPECT_FALSE(isInside(-kNan));
}

const FieldPtr kBox = box({1, 0, 0}, {1, 1, 1});
const FieldPtr kBeside = box({3, 0, 0}, {1, 1, 1});

TEST(Boundary, PrimitivesHoldTheirs) {
  expectZero(kBox, {2, 0.5, 0.5}, true);
  expectZero(sphere({0, 0, 0}, 5), {3, 4, 0}, true);
  expectZero(plane({0, 0, 2}, {0, 0, 1}), {7, -3, 2}, true);
  expectZero(roundedBox({0, 0, 0}, {1, 2, 3}, 0.25), {1, 0, 0}, true);
  expectZero(cylinder({0, 0, 0}, {0, 0, 4}, 5), {3, 4, 1}, true);
  expectZero(cylinder({0, 0, 0}, {0, 0, 4}, 5), {1, 1, 4}, true);
  expectZero(cappedCone({0, 0, 0}, {0, 0, 4}, 2, 1), {0.5, 0, 4}, true);
  expectZero(torus({0, 0, 0}, {0, 0, 1}, 3, 1), {4, 0, 0}, true);
  expectZero(capsule({0, 0, 0}, {0, 0, 4}, 1), {1, 0, 2}, true);
  expectZero(ellipsoid({0, 0, 0}, {1, 2, 4}), {0, 2, 0}, true);
}

TEST(Boundary, RoundingDoesNotPartSolidsOnDecimalNumbers) {
  // 3 * 0.1 is above 0.3 and 0.15 + 0.15 is not: the faces meet up to that.
  const double at = 3 * 0.1;
  ASSERT_NE(at, 0.3);
  expectZero(box({0.15, 0, 0}, {0.15, 1, 1}), {at, 0, 0}, true);
  expectZero(box({0.45, 0, 0}, {0.15, 1, 1}), {at, 0, 0}, true);
}

TEST(Boundary, ComplementsFormulasAndFunctionsDoNotHoldTheirs) {
  expectZero(complement(kBox), {2, 0.5, 0.5}, false);
  expectZero(complement(complement(kBox)), {2, 0.5, 0.5}, true);
  expectZero(formula("-x"), {0, 0, 0}, false);
  expectZero(formula("x"), {0, 0, 0}, false);
  expectZero(functionField({.value = [](const Vec3d& p) { return -p.x; }}), {0, 0, 0}, false);
}

TEST(Boundary, ATouchingUnionHasNoGap) {
  expectZero(unite({kBox, kBeside}), {2, 0, 0}, true);
  expectZero(unite({complement(kBox), kBox}), {2, 0, 0}, true);
  expectZero(unite({kBox, complement(kBox)}), {2, 0, 0}, true);
  expectZero(unite({formula("x-2"), kBeside}), {2, 0, 0}, true);
}

TEST(Boundary, AFlushCutLeavesNothing) {
  expectZero(subtract({kBox, kBeside}), {2, 0, 0}, false);
  expectZero(subtract({kBox, kBox}), {2, 0, 0}, false);
  expectZero(intersect({kBox, complement(kBox)}), {2, 0, 0}, false);
  expectZero(intersect({complement(kBox), kBox}), {2, 0, 0}, false);
  expectZero(intersect({kBox, kBeside}), {2, 0, 0}, true);
}

TEST(Boundary, OffsetsAndShellsHoldTheirs) {
  expectZero(offset(kBox, 0.5), {2.5, 0, 0}, true);
  expectZero(offset(kBox, -0.5), {1.5, 0, 0}, true);
  expectZero(shell(kBox, 0.5), {2.25, 0, 0}, true);
  expectZero(shell(kBox, 0.5), {1.75, 0, 0}, true);
  expectZero(offset(complement(kBox), 0), {2, 0, 0}, false);
}

TEST(Boundary, PlacedFieldsKeepTheirs) {
  expectZero(translate(kBox, {1, 0, 0}), {3, 0, 0}, true);
  expectZero(translate(complement(kBox), {1, 0, 0}), {3, 0, 0}, false);
  expectZero(rotate(kBox, {0, 0, 1}, 90), {0, 2, 0}, true);
  expectZero(scale(kBox, 3), {6, 0, 0}, true);
  expectZero(mirror(kBox, 0), {0, 0.5, 0.5}, true);
  expectZero(repeat(box({0, 0, 0}, {1, 1, 1}), {2, 0, 0}, {0, 0, 0}), {5, 0, 0}, true);
}

TEST(Boundary, SharpResultsOfSmoothOperatorsKeepTheirSign) {
  expectZero(smoothSubtract({kBox, sphere({9, 9, 9}, 1)}, 0.1), {2, 0, 0}, true);
  expectZero(smoothIntersect({kBox, sphere({0, 0, 0}, 9)}, 0.1), {2, 0, 0}, true);
}

TEST(Boundary, BoundsReachZeroWhereValuesCountAsZero) {
  const Box hair{{2 + 1e-14, 0, 0}, {3, 1, 1}};
  EXPECT_TRUE(isInside(kBox->valueAt(hair.lo)));
  EXPECT_LE(kBox->bound(hair).lo, 0);
  EXPECT_LE(offset(kBox, 0.5)->bound({{2.5 + 1e-15, 0, 0}, {3, 1, 1}}).lo, 0);
}

}  // namespace
}  // namespace pdc
