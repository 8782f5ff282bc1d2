#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "field/field_checks.h"
#include "pdc/field/function_field.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

using test::Random;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Box kRegion{{-3, -3, -3}, {3, 3, 3}};

/// Round numbers, so that faces touch and values are zeros of either sign.
double roundNumber(Random& random, double lo, double hi) { return std::round(2 * random.in(lo, hi)) / 2; }
Vec3d roundPoint(Random& random) {
  return {roundNumber(random, -2, 2), roundNumber(random, -2, 2), roundNumber(random, -2, 2)};
}
double halfOrMore(Random& random) { return roundNumber(random, 0.5, 1.5); }
int pick(Random& random, int size) { return static_cast<int>(random.in(0, size - 1e-9)); }

/// Without values beyond a plane, whatever its bounds say.
FieldPtr partlyMissing(Random& random) {
  const Vec3d center = roundPoint(random), side = roundPoint(random);
  return functionField({.value = [=](const Vec3d& p) { return dot(p, side) > 0.5 ? kNan : length(p - center) - 0.5; },
                        .gradient = [=](const Vec3d& p) { return p - center; },
                        .lipschitz = 1.0});
}

FieldPtr randomShape(Random& random) {
  const Vec3d at = roundPoint(random), size{halfOrMore(random), halfOrMore(random), halfOrMore(random)};
  Vec3d to = roundPoint(random);
  if (to == at) to.z += 1;
  switch (pick(random, 11)) {
    case 0:
      return sphere(at, 0.5);
    case 1:
      return roundedBox(at, size, 0.25);
    case 2:
      return cylinder(at, to, 0.5);
    case 3:
      return capsule(at, to, 0.5);
    case 4:
      return cappedCone(at, to, 0.5, 0.25);
    case 5:
      return torus(at, to - at, 1, 0.25);
    case 6:
      return ellipsoid(at, size);
    case 7:
      return plane(at, to - at);
    case 8:
      return random.in(0, 1) < 0.3 ? gyroid(2, 0.25) : partlyMissing(random);
    default:
      return box(at, size * 0.5);
  }
}

FieldPtr randomTree(Random& random, int depth);

std::vector<FieldPtr> randomTrees(Random& random, int depth) {
  std::vector<FieldPtr> trees(static_cast<std::size_t>(2 + pick(random, 7)));
  for (FieldPtr& tree : trees) tree = randomTree(random, depth);
  return trees;
}

FieldPtr randomTree(Random& random, int depth) {
  if (depth == 0) return randomShape(random);
  switch (pick(random, 14)) {
    case 0:
      return intersect(randomTrees(random, depth - 1));
    case 1:
    case 2:
      return subtract(randomTrees(random, depth - 1));
    case 3:
      return smoothUnite(randomTrees(random, depth - 1), 0.3);
    case 4:
      return complement(randomTree(random, depth));
    case 5:
      return offset(randomTree(random, depth), 0.25);
    case 6:
      return shell(randomTree(random, depth), 0.25);
    case 7:
      return rotate(randomTree(random, depth), roundPoint(random) + Vec3d{0, 0, 0.1}, 90 * random.in(0, 3));
    case 8:
      return scale(translate(randomTree(random, depth), roundPoint(random)), Vec3d{2, 1, 0.5});
    case 9:
      return mirror(randomTree(random, depth), pick(random, 3));
    case 10:
      return repeat(randomTree(random, depth), {2, 0, 3}, {1, 0, 0});
    default:
      return unite(randomTrees(random, depth - 1));
  }
}

Box randomBox(Random& random, const Box& region) {
  Vec3d a = random.in(region), b = random.in(region);
  if (random.in(0, 1) < 0.7) b = a + (b - a) * 0.2;
  Box box = Box::empty();
  box.include(a);
  box.include(b);
  return box;
}

struct Points {
  std::array<double, Field::kMaxBatch> x, y, z;

  Points(Random& random, const Box& box) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      Vec3d p = random.in(box);
      for (int axis = 0; axis < 3; ++axis)
        if (const double round = std::round(4 * p[axis]) / 4;
            i % 2 == 0 && box.lo[axis] <= round && round <= box.hi[axis])
          p[axis] = round;
      if (i % 8 == 1) p.x = box.lo.x;
      x[i] = p.x;
      y[i] = p.y;
      z[i] = p.z;
    }
  }
  [[nodiscard]] PointSpan span() const { return {x.data(), y.data(), z.data(), x.size()}; }
};

struct Results {
  std::array<double, Field::kMaxBatch> alone, value, x, y, z;

  Results(const Field& field, const Points& points) {
    field.values(points.span(), alone.data());
    field.gradients(points.span(), value.data(), {x.data(), y.data(), z.data()});
  }
};

bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void expectEqual(const Field& field, const Field& simpler, const Points& points) {
  const Results expected(field, points), found(simpler, points);
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    ASSERT_TRUE(same(expected.alone[i], found.alone[i])) << expected.alone[i] << " became " << found.alone[i];
    ASSERT_TRUE(same(expected.value[i], found.value[i]));
    // Where there is no value the gradient is that of any operand.
    if (std::isnan(expected.value[i])) continue;
    ASSERT_TRUE(same(expected.x[i], found.x[i]) && same(expected.y[i], found.y[i]) && same(expected.z[i], found.z[i]));
  }
}

TEST(SimplifiedField, EqualsTheFieldInTheBox) {
  Random random(11);
  int simplified = 0, twice = 0;
  for (int tree = 0; tree < 200; ++tree) {
    const FieldPtr field = randomTree(random, 1 + tree % 3);
    for (int i = 0; i < 20; ++i) {
      const Box box = randomBox(random, kRegion);
      const FieldPtr simpler = field->simplified(box);
      if (!simpler) continue;
      ++simplified;
      EXPECT_LE(simpler->parts(), field->parts());
      ASSERT_NO_FATAL_FAILURE(expectEqual(*field, *simpler, Points(random, box))) << tree;
      const Box part = randomBox(random, box);
      const FieldPtr simplest = simpler->simplified(part);
      if (!simplest) continue;
      ++twice;
      ASSERT_NO_FATAL_FAILURE(expectEqual(*field, *simplest, Points(random, part))) << tree;
    }
  }
  EXPECT_GT(simplified, 1000);
  EXPECT_GT(twice, 200);
}

TEST(SimplifiedField, BoundsHoldWithinTheBox) {
  Random random(12);
  for (int tree = 0; tree < 200; ++tree) {
    const FieldPtr field = randomTree(random, 2);
    for (int i = 0; i < 20; ++i) {
      const Box box = randomBox(random, kRegion), part = randomBox(random, box);
      const FieldPtr simpler = field->simplified(box);
      // Operations on what is partly missing may have values beyond their bounds where it is.
      if (!simpler || !field->definedIn(kRegion)) continue;
      const Interval bound = simpler->bound(part);
      const Points points(random, part);
      const Results results(*field, points);
      for (const double value : results.alone) ASSERT_TRUE(std::isnan(value) || bound.contains(value)) << tree;
    }
  }
}

TEST(SimplifiedField, DefinedWhereItSaysSo) {
  Random random(13);
  int defined = 0;
  for (int tree = 0; tree < 1000; ++tree) {
    const FieldPtr field = randomTree(random, tree % 3);
    const Box box = randomBox(random, kRegion);
    if (!field->definedIn(box)) continue;
    ++defined;
    const Results results(*field, Points(random, box));
    for (const double value : results.alone) ASSERT_FALSE(std::isnan(value)) << tree;
  }
  EXPECT_GT(defined, 300);
  EXPECT_FALSE(partlyMissing(random)->definedIn(kRegion));
  EXPECT_FALSE(cylinder({0, 0, 0}, {0, 0, 1}, 1)->definedIn({{-1e200, 0, 0}, {1e200, 1, 1}}));
}

std::vector<FieldPtr> row(int size) {
  std::vector<FieldPtr> spheres;
  for (int i = 0; i < size; ++i) spheres.push_back(sphere({double(i), 0, 0}, 0.4));
  return spheres;
}

const Box kAboutTwo{{1.8, -0.2, -0.2}, {2.2, 0.2, 0.2}};

std::size_t partsIn(const FieldPtr& field, const Box& box) {
  const FieldPtr simpler = field->simplified(box);
  return (simpler ? simpler : field)->parts();
}

TEST(SimplifiedField, HasThePartsThatDecide) {
  const FieldPtr spheres = unite(row(100));
  EXPECT_EQ(spheres->parts(), 100u);
  EXPECT_EQ(partsIn(spheres, kAboutTwo), 1u);
  EXPECT_EQ(partsIn(spheres, {{2.4, 0, 0}, {2.6, 0, 0}}), 2u);
  EXPECT_EQ(partsIn(subtract({plane({0, 0, 0}, {0, 0, 1}), complement(spheres)}), kAboutTwo), 2u);
  const Box aboutNine{{8.8, -0.2, -0.2}, {9.2, 0.2, 0.2}};
  EXPECT_EQ(partsIn(unite({translate(spheres, {7, 0, 0}), sphere({9, 9, 9}, 1)}), aboutNine), 1u);
}

TEST(SimplifiedField, SubtractsAndIntersectsWithWhatIsNear) {
  std::vector<FieldPtr> cut = row(100), planes;
  cut.insert(cut.begin(), box({50, 0, 0}, {60, 1, 1}));
  EXPECT_EQ(partsIn(subtract(cut), kAboutTwo), 2u);
  for (int i = 0; i < 100; ++i) planes.push_back(plane({double(i), 0, 0}, {1, 0, 0}));
  EXPECT_EQ(partsIn(intersect(planes), kAboutTwo), 1u);
}

TEST(SimplifiedField, NoneWhereAllDecide) {
  const FieldPtr ball = sphere({0, 0, 0}, 1);
  EXPECT_EQ(ball->parts(), 1u);
  EXPECT_EQ(ball->simplified(kRegion), nullptr);
  EXPECT_EQ(unite({ball, ball})->simplified(kRegion), nullptr);
  EXPECT_EQ(smoothUnite(row(100), 0.1)->parts(), 1u);
  EXPECT_EQ(smoothUnite(row(100), 0.1)->simplified(kAboutTwo), nullptr);
}

/// The operand that has the least bound is the one without a value.
TEST(SimplifiedField, OthersCountWhereTheNearestIsMissing) {
  const FieldPtr nearest = functionField({.value = [](const Vec3d& p) { return p.x > 2 ? kNan : -10.0; },
                                          .gradient = [](const Vec3d&) { return Vec3d{}; },
                                          .lipschitz = 0.1});
  for (const FieldPtr& field :
       {unite({nearest, sphere({2, 0, 0}, 1), sphere({2.5, 0, 0}, 1)}),
        subtract({plane({9, 0, 0}, {-1, 0, 0}), nearest, sphere({2, 0, 0}, 1)}),
        intersect({complement(nearest), sphere({2, 0, 0}, 1)}), intersect({plane({-9, 0, 0}, {1, 0, 0}), nearest})}) {
    const FieldPtr simpler = field->simplified({{1.7, 0, 0}, {2.2, 0, 0}});
    if (!simpler) continue;
    for (const double x : {1.7, 2.0, 2.1, 2.2})
      EXPECT_TRUE(same(simpler->valueAt({x, 0, 0}), field->valueAt({x, 0, 0}))) << x;
  }
}

}  // namespace
}  // namespace pdc
