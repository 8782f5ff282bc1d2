#include "pdc/field/grid_field.h"

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "field/field_checks.h"
#include "folders.h"
#include "pdc/error.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

using openvdb::Coord;
using openvdb::DoubleGrid;
using openvdb::FloatGrid;
using test::FieldCase;
using test::Random;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr float kRadius = 3, kVoxel = 0.1F;
const Vec3d kCenter{0.3, -0.5, 0.2};

FloatGrid::Ptr ball() { return openvdb::tools::createLevelSetSphere<FloatGrid>(kRadius, {0.3F, -0.5F, 0.2F}, kVoxel); }

/// Smooth random values on a small dense patch and tiles around it, under a transform that mirrors and shears.
DoubleGrid::Ptr patch() {
  auto grid = DoubleGrid::create(0.25);
  grid->tree().fill(openvdb::CoordBBox({-64, -64, -64}, {63, 63, 63}), -0.5);
  auto accessor = grid->getAccessor();
  Random random(1);
  for (int x = -12; x < 13; ++x)
    for (int y = -9; y < 10; ++y)
      for (int z = -14; z < 15; ++z) accessor.setValue({x, y, z}, random.in(-1, 1));
  const openvdb::Mat4R m(0.2, 0.1, 0.0, 0.0, -0.05, 0.3, 0.02, 0.0, 0.1, 0.0, -0.25, 0.0, 0.4, -0.3, 0.1, 1.0);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(m));
  return grid;
}

std::vector<FieldCase> grids() {
  const Box nearCenter{{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}};
  return {{"levelSet", gridField(ball(), 0, false), false, 2},
          {"higherInside", gridField(ball(), 0.05, true), false, 2},
          {"shearedDoubles", gridField(patch(), 0.1, false), false, 60, nearCenter}};
}

class GridField : public testing::TestWithParam<FieldCase> {};

TEST_P(GridField, BoundsHold) { test::expectBoundsHold(GetParam()); }
TEST_P(GridField, BoundsConverge) { test::expectBoundsConverge(GetParam()); }
TEST_P(GridField, BatchesAgree) { test::expectBatchesAgree(GetParam()); }
TEST_P(GridField, GradientsMatchDifferences) { test::expectGradientsMatchDifferences(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, GridField, testing::ValuesIn(grids()), testing::PrintToStringParamName());

TEST(GridField, IsTheLevelSetsDistanceInItsBand) {
  const auto field = gridField(ball(), 0, false), exact = sphere(kCenter, kRadius);
  Random random(2);
  int inBand = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3d p = random.in({{-4, -4, -4}, {4, 4, 4}});
    const double d = exact->valueAt(p), value = field->valueAt(p);
    // Linear interpolation of a distance is off by h²/8 times its curvature 1/r per axis that curves.
    if (std::abs(d) < 0.1) {
      ++inBand;
      EXPECT_NEAR(value, d, 2 * kVoxel * kVoxel / 8 / (kRadius - 0.2) + 1e-6);
      EXPECT_LT(length(field->gradientAt(p) - exact->gradientAt(p)), 1.5 * kVoxel / kRadius);
    } else if (std::abs(d) > 0.5) {
      EXPECT_FLOAT_EQ(static_cast<float>(value), d > 0 ? 0.3F : -0.3F);
      EXPECT_EQ(length(field->gradientAt(p)), 0);
    }
  }
  EXPECT_GT(inBand, 500);
}

TEST(GridField, GivesTheVoxelsAtTheirCenters) {
  const auto grid = patch();
  const auto field = gridField(grid, 0.1, false), flipped = gridField(grid, 0.1, true);
  for (const Coord c : {Coord(0, 0, 0), Coord(-12, -9, -14), Coord(12, 9, 14), Coord(7, -8, 3), Coord(1000, 0, 0)}) {
    const openvdb::Vec3d p = grid->indexToWorld(c);
    const double expected = grid->tree().getValue(c) - 0.1;
    EXPECT_NEAR(field->valueAt({p.x(), p.y(), p.z()}), expected, 1e-12);
    EXPECT_NEAR(flipped->valueAt({p.x(), p.y(), p.z()}), -expected, 1e-12);
  }
}

TEST(GridField, AgreesWithTheTrilinearFormula) {
  const auto grid = patch();
  const auto field = gridField(grid, 0, false);
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d q = random.in({{-16, -16, -16}, {16, 16, 16}});
    const Coord lower(static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)),
                      static_cast<int>(std::floor(q.z)));
    double expected = 0;
    for (int k = 0; k < 8; ++k) {
      const Coord c = lower.offsetBy(k & 1, k >> 1 & 1, k >> 2);
      expected += (1 - std::abs(q.x - c.x())) * (1 - std::abs(q.y - c.y())) * (1 - std::abs(q.z - c.z())) *
                  grid->tree().getValue(c);
    }
    const openvdb::Vec3d p = grid->indexToWorld(openvdb::Vec3d(q.x, q.y, q.z));
    EXPECT_NEAR(field->valueAt({p.x(), p.y(), p.z()}), expected, 1e-11);
  }
}

TEST(GridField, BoundsAreTight) {
  const auto field = gridField(ball(), 0, false), exact = sphere(kCenter, kRadius);
  const double band = 3 * kVoxel;
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const Box box = random.boxIn({{-3, -3, -3}, {3, 3, 3}}, 0.05, 0.5);
    const Interval bound = field->bound(box), distance = exact->bound(box);
    EXPECT_GE(bound.lo, std::clamp(distance.lo, -band, band) - 0.03);
    EXPECT_LE(bound.hi, std::clamp(distance.hi, -band, band) + 0.03);
  }
  for (const double half : {0.4, 0.8}) {
    const Vec3d corner{half, half, half};
    const Interval inside = field->bound({kCenter - corner, kCenter + corner});
    EXPECT_NEAR(inside.lo, -band, 1e-6);
    EXPECT_NEAR(inside.hi, -band, 1e-6);
  }
  const Interval all = field->bound({{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}});
  EXPECT_NEAR(all.lo, -band, 1e-6);
  EXPECT_NEAR(all.hi, band, 1e-6);
  const Interval outside = field->bound({{10, 10, 10}, {1e9, 1e9, 1e9}});
  EXPECT_NEAR(outside.lo, band, 1e-6);
}

// Values of their own in tiles of every size, and one voxel far away: each must be seen by a box that touches it,
// whatever the box's size, and by none that is clear of it.
TEST(GridField, BoundsSeeTilesAndFarVoxels) {
  auto grid = FloatGrid::create(0);
  grid->tree().addTile(1, Coord(8, 8, 8), 1, true);
  grid->tree().addTile(2, Coord(-128, 0, 0), 2, false);
  grid->tree().addTile(3, Coord(4096, 0, 0), 3, true);
  grid->tree().setValue(Coord(-1'000'000, 5, 5), -4);
  const auto field = gridField(grid, 0, false);
  const auto boundOf = [&](const Vec3d& lo, const Vec3d& hi) { return field->bound({lo, hi}); };
  const auto expect = [](Interval bound, double lo, double hi) {
    EXPECT_NEAR(bound.lo, lo, 1e-9);
    EXPECT_NEAR(bound.hi, hi, 1e-9);
  };
  expect(boundOf({9, 9, 9}, {14, 14, 14}), 1, 1);
  expect(boundOf({0.5, 0.5, 0.5}, {1, 1, 1}), 0, 0);
  expect(boundOf({0.5, 0.5, 0.5}, {40, 40, 40}), 0, 1);
  expect(boundOf({-100, 10, 10}, {-20, 120, 120}), 2, 2);
  expect(boundOf({-900, -300, -300}, {-600, 300, 300}), 0, 0);
  expect(boundOf({-300, -300, -300}, {300, 300, 300}), 0, 2);
  expect(boundOf({4100, 10, 10}, {8000, 4000, 4000}), 3, 3);
  expect(boundOf({4100, 10, 10}, {9000, 4000, 4000}), 0, 3);
  expect(boundOf({-1e4, -1e4, -1e4}, {1e4, 1e4, 1e4}), 0, 3);
  expect(boundOf({-2e6, -1e4, -1e4}, {1e4, 1e4, 1e4}), -4, 3);
  expect(boundOf({-1e12, -1e12, -1e12}, {1e12, 1e12, 1e12}), -4, 3);
  EXPECT_EQ(field->valueAt({-1'000'000, 5, 5}), -4);
  EXPECT_EQ(field->valueAt({1e12, 0, 0}), 0);
}

TEST(GridField, BoundsOfABoxAnywhereHoldTheVoxelsItTouches) {
  const auto grid = patch();
  grid->setTransform(openvdb::math::Transform::createLinearTransform(1.0));
  const auto field = gridField(grid, 0, false);
  Random random(5);
  for (int i = 0; i < 400; ++i) {
    const Box box = random.boxIn({{-20, -20, -20}, {20, 20, 20}}, 4, 200);
    const Interval bound = field->bound(box);
    for (int x = static_cast<int>(std::ceil(box.lo.x)); x <= box.hi.x; x += 3)
      for (int y = static_cast<int>(std::ceil(box.lo.y)); y <= box.hi.y; y += 3)
        for (int z = static_cast<int>(std::ceil(box.lo.z)); z <= box.hi.z; z += 3)
          ASSERT_TRUE(bound.contains(grid->tree().getValue({x, y, z})));
  }
}

TEST(GridField, NanVoxelsHaveNoValueAndNoPartInBounds) {
  auto grid = FloatGrid::create(1);
  grid->tree().setValue(Coord(0, 0, 0), std::numeric_limits<float>::quiet_NaN());
  grid->tree().setValue(Coord(-2, -2, -2), -std::numeric_limits<float>::infinity());
  grid->tree().setValue(Coord(3, 3, 3), -1);
  const auto field = gridField(grid, 0, false, true);
  EXPECT_TRUE(std::isnan(field->valueAt({-2, -2, -2})));
  EXPECT_TRUE(std::isnan(field->valueAt({0.5, 0.5, 0.5})));
  EXPECT_EQ(field->valueAt({1, 1, 1}), 1);
  EXPECT_TRUE(std::isnan(field->valueAt({kNan, 0, 0})));
  for (const double size : {3.0, 300.0}) {
    const Interval bound = field->bound({{-size, -size, -size}, {size, size, size}});
    EXPECT_NEAR(bound.lo, -1, 1e-9);
    EXPECT_NEAR(bound.hi, 1, 1e-9);
  }
  EXPECT_FALSE(field->bound({{0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}}).bounded());
}

TEST(GridField, RefusesVoxelsThatAreNotFinite) {
  const auto messageOf = [](const openvdb::GridBase::ConstPtr& grid) -> std::string {
    try {
      gridField(grid, 0, false);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  auto grid = FloatGrid::create(1);
  grid->tree().setValue(Coord(5, 6, 7), std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(
      messageOf(grid),
      "1 voxel is not finite: at (5, 6, 7) it is nan; --nan outside (acceptNonFinite in C++) takes such values as "
      "outside");
  grid->tree().addTile(1, Coord(16, 0, 0), std::numeric_limits<float>::infinity(), false);
  grid->tree().addTile(3, Coord(-4096, 0, 0), -std::numeric_limits<float>::infinity(), true);
  grid->tree().addTile(2, Coord(4096, 0, 0), std::numeric_limits<float>::quiet_NaN(), true);
  EXPECT_EQ(messageOf(grid).substr(0, 69), "4 voxels are not finite, the first at (-4096, 0, 0) is -inf; --nan ou");
  auto unknown = FloatGrid::create(std::numeric_limits<float>::infinity());
  unknown->tree().addTile(1, Coord(0, 0, 0), 1, true);
  EXPECT_EQ(messageOf(unknown), "") << "only the background is not finite";
}

TEST(GridField, GivesTheSameBitsInAnyThread) {
  const auto field = gridField(ball(), 0, false);
  constexpr std::size_t kPoints = 20'000;
  std::vector<Vec3d> points(kPoints);
  std::vector<double> serial(kPoints), parallel(kPoints);
  Random random(6);
  for (Vec3d& p : points) p = random.in({{-4, -4, -4}, {4, 4, 4}});
  for (std::size_t i = 0; i < kPoints; ++i)
    serial[i] = field->valueAt(points[i]) + field->bound({points[i], points[i]}).lo;
  tbb::parallel_for(std::size_t{0}, kPoints, [&](std::size_t i) {
    parallel[i] = field->valueAt(points[i]) + field->bound({points[i], points[i]}).lo;
  });
  EXPECT_EQ(serial, parallel);
}

TEST(GridField, TakesAnEmptyGrid) {
  const auto field = gridField(FloatGrid::create(2), 0.5, false);
  EXPECT_EQ(field->valueAt({1, 2, 3}), 1.5);
  const Interval bound = field->bound({{-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}});
  EXPECT_NEAR(bound.lo, 1.5, 1e-9);
  EXPECT_NEAR(bound.hi, 1.5, 1e-9);
}

TEST(GridField, RefusesWhatItCannotRead) {
  EXPECT_THROW(gridField(nullptr, 0, false), std::invalid_argument);
  EXPECT_THROW(gridField(ball(), kNan, false), std::invalid_argument);
  EXPECT_THROW(gridField(openvdb::Int32Grid::create(), 0, false), Error);
  EXPECT_THROW(gridField(openvdb::Vec3SGrid::create(), 0, false), Error);
  const auto frustum = ball();
  frustum->setTransform(openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(100)), 0.5, 10, 0.1));
  EXPECT_THROW(gridField(frustum, 0, false), Error);
  try {
    auto grid = openvdb::BoolGrid::create();
    grid->setName("mask");
    gridField(grid, 0, false);
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "grid \"mask\": values of type bool, expected float or double");
  }
}

TEST(GridField, ReadsARealLevelSet) {
  const auto path = test::dataFolder() / "vdb" / "ovdb_sphere.vdb";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
  openvdb::initialize();
  openvdb::io::File file(path.string());
  file.open();
  const auto field = gridField(file.readGrid("ls_sphere"), 0, false), exact = sphere({0, 0, 0}, 3);
  Random random(7);
  for (int i = 0; i < 5000; ++i) {
    const Vec3d direction = random.in({{-1, -1, -1}, {1, 1, 1}});
    const Vec3d p = direction * (random.in(2.95, 3.05) / length(direction));
    // The file holds half floats.
    EXPECT_NEAR(field->valueAt(p), exact->valueAt(p), 5e-4);
    const double size = random.in(0, 0.3);
    EXPECT_TRUE(field->bound({p - Vec3d{size, 0, 0}, p + Vec3d{0, size, size}}).contains(field->valueAt(p)));
  }
}

}  // namespace
}  // namespace pdc
