#include "pdc/sample/meaning/grid_meaning.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using Doubts = std::vector<GridDoubt>;

constexpr double kPi = 3.14159265358979323846;
constexpr int kHalf = 16;      // Half the edge of dense grids, in voxels.
constexpr float kRadius = 10;  // The radius of all balls.
constexpr double ballVolume(double radius) { return 4.0 / 3.0 * kPi * radius * radius * radius; }
constexpr double kVolume = ballVolume(kRadius);

float distance(const Coord& c) { return static_cast<float>(c.asVec3d().length()) - kRadius; }

/// What an array of size (2 kHalf + 1)³ becomes: values that are the background are not active.
template <typename GridT = FloatGrid>
typename GridT::Ptr dense(const std::function<double(const Coord&)>& value, typename GridT::ValueType background = 0) {
  auto grid = GridT::create(background);
  auto accessor = grid->getAccessor();
  for (const Coord& c : openvdb::CoordBBox(Coord(-kHalf), Coord(kHalf))) {
    const auto v = static_cast<typename GridT::ValueType>(value(c));
    if (v != background) accessor.setValue(c, v);
  }
  return grid;
}

/// The level set of a ball, half width 3, without a class.
FloatGrid::Ptr ball(double voxelSize = 1) {
  auto grid = openvdb::tools::createLevelSetSphere<FloatGrid>(float(kRadius * voxelSize), {0, 0, 0}, float(voxelSize));
  grid->clearGridClass();
  return grid;
}

FloatGrid::Ptr withClass(FloatGrid::Ptr grid, openvdb::GridClass gridClass) {
  grid->setGridClass(gridClass);
  return grid;
}

FloatGrid::Ptr scaled(FloatGrid::Ptr grid, float factor) {
  const float background = grid->background();
  for (auto it = grid->beginValueAll(); it; ++it) it.setValue(*it * factor);
  grid->tree().root().setBackground(background * factor, false);
  return grid;
}

/// The level set with all that is inactive as the background, as it is before flood filling.
FloatGrid::Ptr notFilled() {
  auto grid = ball();
  for (auto it = grid->beginValueOff(); it; ++it) it.setValue(grid->background());
  return withClass(grid, openvdb::GRID_LEVEL_SET);
}

struct Expected {
  GridClass gridClass;
  InsideValues inside;
  Doubts doubts{};
};

void expectMeaning(const FloatGrid::Ptr& grid, const Expected& expected, const GridMeaningOptions& options = {}) {
  const GridMeaning meaning = readMeaning(grid, options).meaning;
  EXPECT_EQ(meaning.gridClass, expected.gridClass);
  EXPECT_EQ(meaning.inside, expected.inside);
  EXPECT_EQ(meaning.doubts, expected.doubts);
}

/// Expects one closed solid of this volume.
void expectSolid(const openvdb::GridBase::ConstPtr& grid, double volume, const GridSourceOptions& options = {}) {
  const MeshReport r = analyze(contour(GridSource(grid, options)));
  EXPECT_EQ(r.boundaryEdges, 0u);
  EXPECT_EQ(r.eulerNumber, 2);
  EXPECT_EQ(r.components, 1u);
  EXPECT_NEAR(r.volume / volume, 1, 0.02);
}

constexpr Expected kLowLevelSet{GridClass::kLevelSet, InsideValues::kLow};
constexpr Expected kHighLevelSet{GridClass::kLevelSet, InsideValues::kHigh};
constexpr Expected kHighFog{GridClass::kFogVolume, InsideValues::kHigh};

class GridMeaningTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }
};

TEST_F(GridMeaningTest, TheClassOfTheFileHolds) {
  const auto levelSet = withClass(ball(), openvdb::GRID_LEVEL_SET);
  expectMeaning(levelSet, kLowLevelSet);
  const ReadableGrid readable = readMeaning(levelSet);
  EXPECT_EQ(readable.grid, levelSet);
  EXPECT_EQ(readable.meaning.classBy, DecidedBy::kFile);
  EXPECT_EQ(readable.meaning.insideBy, DecidedBy::kFile);
  EXPECT_EQ(readable.clamp, 3);
  EXPECT_NEAR(readable.meaning.halfWidth, 3, 0.01);
  auto fog = withClass(ball(), openvdb::GRID_LEVEL_SET);
  openvdb::tools::sdfToFogVolume(*fog);
  expectMeaning(fog, kHighFog);
}

TEST_F(GridMeaningTest, DistancesWithoutAClassAreALevelSetInAnyUnit) {
  for (const double voxelSize : {1.0, 0.02, 50.0}) {
    expectMeaning(ball(voxelSize), kLowLevelSet);                                      // In world units.
    expectMeaning(scaled(ball(voxelSize), float(1 / voxelSize)), kLowLevelSet);        // In voxels.
    expectMeaning(scaled(ball(voxelSize), float(1 / (3 * voxelSize))), kLowLevelSet);  // In units of the band.
    expectSolid(scaled(ball(voxelSize), 0.1F), kVolume * std::pow(voxelSize, 3));
  }
  EXPECT_EQ(readMeaning(ball()).meaning.classBy, DecidedBy::kValues);
  EXPECT_EQ(readMeaning(ball()).meaning.insideBy, DecidedBy::kValues);
}

TEST_F(GridMeaningTest, DenseDistancesAboutAnyBackgroundAreALevelSet) {
  for (const float background : {0.0F, 1.0F, -1.0F, 100.0F}) {
    const auto grid = dense(distance, background);
    expectMeaning(grid, kLowLevelSet);
    // A background that is inside must not leave a shell where the array ends.
    for (const double iso : {0.0, 1.0, -2.0, 4.0}) expectSolid(grid, ballVolume(kRadius + iso), {.iso = iso});
  }
}

TEST_F(GridMeaningTest, DensePositiveInsideIsTurned) {
  for (const float background : {0.0F, -1.0F}) {
    const auto grid = dense([](const Coord& c) { return -distance(c); }, background);
    expectMeaning(grid, kHighLevelSet);
    for (const double iso : {0.0, 1.0, -2.0, -4.0}) expectSolid(grid, ballVolume(kRadius - iso), {.iso = iso});
  }
}

TEST_F(GridMeaningTest, APositiveInsideIsTurnedAgainstTheClassButSaid) {
  const auto turned = scaled(ball(), -1);
  expectMeaning(turned, kHighLevelSet);
  expectSolid(turned, kVolume);
  withClass(turned, openvdb::GRID_LEVEL_SET);
  expectMeaning(turned, {GridClass::kLevelSet, InsideValues::kHigh, {GridDoubt::kPositiveInside}});
  expectSolid(turned, kVolume);
  expectSolid(turned, ballVolume(kRadius - 1), {.iso = 1});
  expectMeaning(turned, kLowLevelSet, {.inside = InsideValues::kLow});
  expectMeaning(turned, kHighLevelSet, {.inside = InsideValues::kHigh});
}

TEST_F(GridMeaningTest, ActiveValuesAloneTurnedAreDoubted) {
  auto grid = withClass(ball(), openvdb::GRID_LEVEL_SET);
  for (auto it = grid->beginValueOn(); it; ++it) it.setValue(-*it);
  expectMeaning(grid, {GridClass::kLevelSet, InsideValues::kLow, {GridDoubt::kOutermostInside}});
  expectMeaning(grid, kHighLevelSet, {.inside = InsideValues::kHigh});
  expectSolid(grid, kVolume, {.inside = InsideValues::kHigh});
}

TEST_F(GridMeaningTest, ACaveIsSolidAroundIfThatIsSaidOrSeen) {
  // Rock about a cave that has a way out: the outermost values are on both sides.
  const auto rock = dense([](const Coord& c) {
    const double way = std::hypot(c.x(), c.y()) - 4;
    return -std::min<double>(distance(c), c.z() > 0 ? way : 1e3);
  });
  expectMeaning(rock, {GridClass::kLevelSet, InsideValues::kLow, {GridDoubt::kSideUnclear}});
  const Expected cut{GridClass::kLevelSet, InsideValues::kLow, {GridDoubt::kCutAtEnd}};
  expectMeaning(rock, cut, {.inside = InsideValues::kLow});
  const double cube = std::pow(2 * kHalf + 2, 3), way = kPi * 16 * (kHalf + 1 - kRadius);
  EXPECT_NEAR(analyze(contour(GridSource(rock))).volume / (cube - kVolume - way), 1, 0.06);
}

TEST_F(GridMeaningTest, DensitiesWithoutAClassAreFogs) {
  auto fog = withClass(ball(), openvdb::GRID_LEVEL_SET);
  openvdb::tools::sdfToFogVolume(*fog);
  fog->clearGridClass();
  expectMeaning(fog, kHighFog);
  EXPECT_EQ(readMeaning(fog).meaning.iso, 0.5);
  const auto occupancy = dense([](const Coord& c) { return 1 / (1 + std::exp(2 * distance(c))); });
  expectMeaning(occupancy, kHighFog);
  expectSolid(occupancy, kVolume);
  expectSolid(occupancy, ballVolume(kRadius + std::log(7.0 / 3) / 2), {.iso = 0.3});
}

TEST_F(GridMeaningTest, NoiseOfADensityIsNoSign) {
  std::mt19937 engine(5);
  std::normal_distribution<double> noise(0, 0.01);
  const auto fog = dense([&](const Coord& c) { return 1 / (1 + std::exp(2 * distance(c))) + noise(engine); });
  expectMeaning(fog, kHighFog);
  expectSolid(fog, kVolume);
}

TEST_F(GridMeaningTest, DensitiesInOtherUnitsNeedAnIsovalue) {
  const auto scan = dense([](const Coord& c) { return 4096 / (1 + std::exp(distance(c))); });
  expectMeaning(scan, {GridClass::kFogVolume, InsideValues::kHigh, {GridDoubt::kIsoGuessed}});
  expectMeaning(scan, kHighFog, {.iso = 2048});
  expectSolid(scan, kVolume, {.iso = 2048});
  const auto kelvin = dense([](const Coord& c) { return 273 + 1000 / (1 + std::exp(distance(c))); }, 273);
  expectMeaning(kelvin, {GridClass::kFogVolume, InsideValues::kHigh, {GridDoubt::kIsoGuessed}});
  expectSolid(kelvin, kVolume, {.iso = 773});
}

TEST_F(GridMeaningTest, AnIsovalueBelowTheBackgroundLeavesTheSide) {
  // Air has -1000 Hounsfield units, and what lies beyond the array 0.
  const auto scan = dense([](const Coord& c) { return -1000 + 1100 / (1 + std::exp(distance(c))); });
  expectSolid(scan, kVolume, {.iso = -450, .gridClass = GridClass::kFogVolume});
  expectSolid(scan, kVolume, {.iso = -450});
  withClass(scan, openvdb::GRID_FOG_VOLUME);
  expectSolid(scan, kVolume, {.iso = -450});
}

TEST_F(GridMeaningTest, LowDensitiesInsideAreSeenByWhatIsAround) {
  const auto hole = dense([](const Coord& c) { return 1 / (1 + std::exp(-2 * distance(c))); }, 1);
  expectMeaning(hole, {GridClass::kFogVolume, InsideValues::kLow});
  expectSolid(hole, kVolume);
}

TEST_F(GridMeaningTest, UnsignedDistancesAreSaid) {
  const auto unsignedBall = dense([](const Coord& c) { return std::abs(distance(c)); });
  const Expected expected{GridClass::kLevelSet, InsideValues::kLow, {GridDoubt::kUnsigned}};
  expectMeaning(unsignedBall, expected);
  EXPECT_TRUE(contour(GridSource(unsignedBall)).empty());
  expectMeaning(unsignedBall, kLowLevelSet, {.iso = 2});
  EXPECT_NEAR(analyze(contour(GridSource(unsignedBall, {.iso = 2}))).volume / (ballVolume(12) - ballVolume(8)), 1,
              0.02);
  auto band = ball();
  for (auto it = band->beginValueAll(); it; ++it) it.setValue(std::abs(*it));
  expectMeaning(band, expected);
  expectMeaning(withClass(band, openvdb::GRID_LEVEL_SET), expected);
}

TEST_F(GridMeaningTest, SignedValuesThatAreNoDistancesAreDoubted) {
  const auto tanh = dense([](const Coord& c) { return std::tanh(distance(c) / 2); }, 1);
  expectMeaning(tanh, {GridClass::kLevelSet, InsideValues::kLow, {GridDoubt::kClassUnclear}});
  expectSolid(tanh, kVolume);
  const auto quadric = dense([](const Coord& c) { return c.asVec3d().lengthSqr() - 25; });
  expectMeaning(quadric, {GridClass::kLevelSet, InsideValues::kLow, {GridDoubt::kClassUnclear}});
  const auto celsius = dense([](const Coord& c) { return -20 + 820 / (1 + std::exp(distance(c))); }, 20);
  expectMeaning(celsius, {GridClass::kFogVolume, InsideValues::kHigh, {GridDoubt::kIsoGuessed}});
  expectMeaning(celsius, kHighFog, {.gridClass = GridClass::kFogVolume});
}

TEST_F(GridMeaningTest, ClassesThatTheValuesContradictAreDoubted) {
  expectMeaning(withClass(ball(), openvdb::GRID_FOG_VOLUME),
                {GridClass::kFogVolume, InsideValues::kHigh, {GridDoubt::kLooksLikeLevelSet}});
  const auto density = dense([](const Coord& c) { return 1 / (1 + std::exp(2 * distance(c))); });
  expectMeaning(withClass(density, openvdb::GRID_LEVEL_SET),
                {GridClass::kLevelSet, InsideValues::kLow, {GridDoubt::kLooksLikeFog}});
  expectMeaning(density, kHighFog, {.gridClass = GridClass::kFogVolume});
  expectSolid(density, kVolume, {.gridClass = GridClass::kFogVolume});
}

TEST_F(GridMeaningTest, FewValuesInsideAreFound) {
  // A ball of two voxels' diameter among thousands of leaves that hold nothing.
  auto grid = FloatGrid::create(3);
  for (const Coord& c : openvdb::CoordBBox(Coord(0), Coord(127)))
    grid->tree().setValueOn(c, float((c - Coord(90)).asVec3d().length()) - 1.5F);
  expectMeaning(grid, kLowLevelSet);
  expectMeaning(withClass(grid, openvdb::GRID_LEVEL_SET), kLowLevelSet);
}

TEST_F(GridMeaningTest, LevelSetsThatAreNotFloodFilledAreSaidAndFilled) {
  const Expected expected{GridClass::kLevelSet, InsideValues::kLow, {GridDoubt::kNotFloodFilled}};
  expectMeaning(notFilled(), expected);
  expectMeaning(notFilled(), kLowLevelSet, {.floodFill = true});
  expectSolid(notFilled(), kVolume, {.floodFill = true});
  EXPECT_EQ(analyze(contour(GridSource(notFilled()))).components, 2u);
  EXPECT_TRUE(GridSource(notFilled(), {.open = true}).meaning().doubts.empty());
  const auto turned = scaled(notFilled(), -1);
  expectSolid(turned, kVolume, {.inside = InsideValues::kHigh, .floodFill = true});
  EXPECT_THROW(readMeaning(dense(distance), {.floodFill = true}), Error);
  EXPECT_THROW(readMeaning(dense(distance), {.gridClass = GridClass::kFogVolume, .floodFill = true}), Error);
}

TEST_F(GridMeaningTest, ALevelSetThatIsCutOffIsSaidUnlessItStaysOpen) {
  auto clipped = withClass(ball(), openvdb::GRID_LEVEL_SET);
  for (auto it = clipped->beginValueOn(); it; ++it)
    if (it.getCoord().x() > 5) it.setValueOff();
  const Expected expected{GridClass::kLevelSet, InsideValues::kLow, {GridDoubt::kCutAtEnd}};
  expectMeaning(clipped, expected);
  EXPECT_TRUE(GridSource(clipped, {.open = true}).meaning().doubts.empty());
  const auto half = [](const Coord& c) { return distance(c + Coord(0, 0, kHalf)); };
  expectMeaning(dense(half), expected);
  expectMeaning(dense(half, 50), expected);
}

TEST_F(GridMeaningTest, AnIsovalueBesideTheEndOfTheBandIsDoubted) {
  const auto grid = withClass(ball(0.1), openvdb::GRID_LEVEL_SET);
  const Expected expected{GridClass::kLevelSet, InsideValues::kLow, {GridDoubt::kIsoNearBandEnd}};
  for (const double iso : {0.29, -0.29, 0.21}) expectMeaning(grid, expected, {.iso = iso});
  for (const double iso : {0.19, -0.19, 0.0}) expectMeaning(grid, kLowLevelSet, {.iso = iso});
  // Dense distances end nowhere.
  expectMeaning(dense(distance, 5), kLowLevelSet, {.iso = 4.9});
}

TEST_F(GridMeaningTest, ANarrowBandIsDoubted) {
  const auto make = [](float halfWidth) {
    return openvdb::tools::createLevelSetSphere<FloatGrid>(kRadius, {0.2F, 0.1F, 0}, 1, halfWidth);
  };
  for (const float halfWidth : {1.5F, 1.8F})
    expectMeaning(make(halfWidth), {GridClass::kLevelSet, InsideValues::kLow, {GridDoubt::kNarrowBand}});
  for (const float halfWidth : {2.0F, 3.0F, 6.0F}) expectMeaning(make(halfWidth), kLowLevelSet);
}

TEST_F(GridMeaningTest, OtherTypesAreReadAlike) {
  const auto whole = dense<openvdb::Int32Grid>([](const Coord& c) { return std::lround(100 * distance(c)); });
  EXPECT_EQ(readMeaning(whole).meaning.gridClass, GridClass::kLevelSet);
  expectSolid(whole, kVolume);
  expectSolid(dense<openvdb::DoubleGrid>([](const Coord& c) { return -distance(c); }), kVolume);
  const auto labels = dense<openvdb::Int64Grid>([](const Coord& c) { return distance(c) < 0 ? 1 : 0; });
  EXPECT_EQ(readMeaning(labels).meaning.gridClass, GridClass::kFogVolume);
  EXPECT_EQ(readMeaning(labels).meaning.doubts, Doubts{});
  expectSolid(labels, kVolume);
  const auto mask = dense<openvdb::BoolGrid>([](const Coord& c) { return distance(c) < 0 ? 1 : 0; }, false);
  EXPECT_EQ(readMeaning(mask).meaning.classBy, DecidedBy::kType);
  expectSolid(mask, kVolume);
}

TEST_F(GridMeaningTest, TilesAloneHaveAMeaning) {
  auto grid = FloatGrid::create(1);
  grid->tree().addTile(1, Coord(0), -1, true);
  const GridMeaning meaning = readMeaning(grid).meaning;
  EXPECT_EQ(meaning.gridClass, GridClass::kLevelSet);
  EXPECT_EQ(meaning.inside, InsideValues::kLow);
  EXPECT_EQ(readMeaning(FloatGrid::create(0)).meaning.gridClass, GridClass::kFogVolume);
  EXPECT_EQ(readMeaning(FloatGrid::create(3)).meaning.gridClass, GridClass::kLevelSet);
}

TEST_F(GridMeaningTest, ThreadsChangeNothing) {
  const auto grid = dense(distance, -1);
  const auto read = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return readMeaning(grid).meaning;
  };
  const GridMeaning one = read(1), many = read(4);
  EXPECT_EQ(one.slope, many.slope);
  EXPECT_EQ(one.lowest, many.lowest);
  EXPECT_EQ(one.highest, many.highest);
}

TEST_F(GridMeaningTest, Refusals) {
  EXPECT_THROW(readMeaning(nullptr), std::invalid_argument);
  EXPECT_THROW(readMeaning(openvdb::Vec3SGrid::create()), Error);
}

}  // namespace
}  // namespace pdc
