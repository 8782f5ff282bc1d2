#include "pdc/sample/vdb/grid_source.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "pdc/extract/contour.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc {
namespace {

using openvdb::FloatGrid;

constexpr double kPi = 3.14159265358979323846;
double sphereVolume(double r) { return 4.0 / 3.0 * kPi * r * r * r; }

FloatGrid::Ptr sphere(float radius, const openvdb::Vec3f& center = openvdb::Vec3f(0.3F, -0.2F, 0.1F),
                      float halfWidth = 3) {
  return openvdb::tools::createLevelSetSphere<FloatGrid>(radius, center, 1.0F, halfWidth);
}

/// A grid of any type whose active voxels fill a cube of lattice points and hold value(x, y, z).
template <typename GridT>
typename GridT::Ptr cubeGrid(int lo, int hi, typename GridT::ValueType background,
                             const std::function<typename GridT::ValueType(int, int, int)>& value) {
  auto grid = GridT::create(background);
  auto accessor = grid->getAccessor();
  for (int x = lo; x <= hi; ++x)
    for (int y = lo; y <= hi; ++y)
      for (int z = lo; z <= hi; ++z) accessor.setValue({x, y, z}, value(x, y, z));
  return grid;
}

MeshReport reportOf(openvdb::GridBase::ConstPtr grid, const GridSourceOptions& options = {}) {
  return analyze(contour(GridSource(std::move(grid), options)));
}

void expectClosedSolid(const MeshReport& r, long long euler) {
  EXPECT_EQ(r.boundaryEdges, 0u);
  EXPECT_EQ(r.nonManifoldEdges, 0u);
  EXPECT_EQ(r.nonManifoldVertices, 0u);
  EXPECT_EQ(r.misorientedEdges, 0u);
  EXPECT_EQ(r.eulerNumber, euler);
  EXPECT_GT(r.volume, 0);
}

class GridSourceTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }
};

TEST_F(GridSourceTest, SphereIsASphere) {
  const double radius = 30;
  const Mesh mesh = contour(GridSource(sphere(30)));
  const MeshReport r = analyze(mesh);
  expectClosedSolid(r, 2);
  EXPECT_NEAR(r.volume / sphereVolume(radius), 1, 1e-3);
  for (const Vec3f& p : mesh.positions) ASSERT_NEAR(length(vecCast<double>(p) - Vec3d{0.3, -0.2, 0.1}), radius, 0.02);
}

TEST_F(GridSourceTest, HasOneFaceForEachOfVolumeToMesh) {
  for (const float radius : {3.0F, 17.5F, 64.0F}) {
    const auto grid = sphere(radius);
    openvdb::tools::VolumeToMesh peer(0, 0);
    peer(*grid);
    std::size_t quads = 0;
    for (std::size_t i = 0; i < peer.polygonPoolListSize(); ++i) quads += peer.polygonPoolList()[i].numQuads();
    // Certified meshes have fans of triangles in the place of a few quads.
    EXPECT_EQ(contour(GridSource(grid), {.placement = Placement::kFree}).quads.size(), quads) << radius;
  }
}

TEST_F(GridSourceTest, EveryValueTypeGivesTheSameSphere) {
  const auto distance = [](int x, int y, int z) { return std::sqrt(double(x * x + y * y + z * z)) - 9.5; };
  constexpr int kLo = -13, kHi = 13;
  const auto asFloat =
      cubeGrid<FloatGrid>(kLo, kHi, 3.0F, [&](int x, int y, int z) { return float(distance(x, y, z)); });
  const auto asDouble = cubeGrid<openvdb::DoubleGrid>(kLo, kHi, 3.0, distance);
  const auto asInt32 = cubeGrid<openvdb::Int32Grid>(
      kLo, kHi, 3000, [&](int x, int y, int z) { return openvdb::Int32(std::lround(1000 * distance(x, y, z))); });
  const auto asInt64 = cubeGrid<openvdb::Int64Grid>(kLo, kHi, 3000000000000, [&](int x, int y, int z) {
    return openvdb::Int64(std::llround(1e12 * distance(x, y, z)));
  });
  const auto asBool =
      cubeGrid<openvdb::BoolGrid>(kLo, kHi, false, [&](int x, int y, int z) { return distance(x, y, z) < 0; });
  const Mesh reference = contour(GridSource(asFloat));
  expectClosedSolid(analyze(reference), 2);
  for (const openvdb::GridBase::Ptr& grid : std::initializer_list<openvdb::GridBase::Ptr>{asDouble, asInt32, asInt64}) {
    const Mesh mesh = contour(GridSource(grid));
    ASSERT_EQ(mesh.quads.size(), reference.quads.size()) << grid->valueType();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      ASSERT_LT(length(mesh.positions[i] - reference.positions[i]), 5e-3) << grid->valueType();
  }
  const MeshReport stairs = reportOf(asBool);
  expectClosedSolid(stairs, 2);
  EXPECT_EQ(stairs.quads, reference.quads.size());
}

TEST_F(GridSourceTest, RefusesVectors) {
  EXPECT_THROW(GridSource{openvdb::Vec3SGrid::create()}, Error);
  EXPECT_THROW(GridSource{openvdb::GridBase::ConstPtr()}, std::invalid_argument);
}

TEST_F(GridSourceTest, InsideFollowsTheClass) {
  const auto levelSet = sphere(10);
  EXPECT_FALSE(GridSource(levelSet).insideIsHigher());
  EXPECT_EQ(GridSource(levelSet).iso(), 0);

  const auto fog = levelSet->deepCopy();
  openvdb::tools::sdfToFogVolume(*fog);
  const GridSource fogSource(fog);
  EXPECT_TRUE(fogSource.insideIsHigher());
  EXPECT_EQ(fogSource.iso(), 0.5);
  expectClosedSolid(analyze(contour(fogSource)), 2);

  // Without a class the background tells.
  fog->setGridClass(openvdb::GRID_UNKNOWN);
  levelSet->setGridClass(openvdb::GRID_UNKNOWN);
  EXPECT_TRUE(GridSource(fog).insideIsHigher());
  EXPECT_FALSE(GridSource(levelSet).insideIsHigher());
  expectClosedSolid(reportOf(fog), 2);
  expectClosedSolid(reportOf(levelSet), 2);
}

TEST_F(GridSourceTest, AnyIsovalueInTheBandMovesTheSurface) {
  const auto grid = sphere(20);
  for (const double iso : {-2.4, -1.0, 0.5, 2.4}) {
    const Mesh mesh = contour(GridSource(grid, {.iso = iso}));
    expectClosedSolid(analyze(mesh), 2);
    // Near the limits of the band an edge's far end is clamped, which shifts the crossing, but one-sided differences
    // keep the normals.
    const double tolerance = std::abs(iso) < 2 ? 0.03 : 0.1;
    for (const Vec3f& p : mesh.positions)
      ASSERT_NEAR(length(vecCast<double>(p) - Vec3d{0.3, -0.2, 0.1}), 20 + iso, tolerance) << iso;
  }
  EXPECT_TRUE(contour(GridSource(grid, {.iso = 3.5})).empty());
  EXPECT_TRUE(contour(GridSource(grid, {.iso = -3.5})).empty());
  EXPECT_THROW(GridSource(grid, {.iso = NAN}), Error);
}

TEST_F(GridSourceTest, SpheresAcrossNodeBordersAreClosed) {
  for (const float c : {8.0F, 128.0F, 4096.0F, -4096.0F, -128.0F, -0.5F, 1e6F}) {
    const MeshReport r = reportOf(sphere(6, openvdb::Vec3f(c, c + 0.25F, c)));
    expectClosedSolid(r, 2);
    EXPECT_NEAR(r.volume / sphereVolume(6), 1, 0.02) << c;
  }
}

TEST_F(GridSourceTest, TilesHaveSurfaces) {
  for (const bool active : {false, true}) {
    // A dense cube of 3³ tiles of 8³ voxels, no leaf anywhere.
    auto grid = FloatGrid::create(1.0F);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    for (int i = 0; i < 27; ++i)
      grid->tree().addTile(1, openvdb::Coord(8 * (i / 9), 8 * (i / 3 % 3), 8 * (i % 3)), -1.0F, active);
    ASSERT_EQ(grid->tree().leafCount(), 0u);
    const MeshReport r = reportOf(grid);
    expectClosedSolid(r, 2);
    EXPECT_EQ(r.quads, 6u * 24 * 24);
    EXPECT_NEAR(r.volume, 24 * 24 * 24, 1200);

    // One tile of 128³ beside one of 8³.
    grid->clear();
    grid->tree().addTile(2, openvdb::Coord(0, 0, 0), -1.0F, active);
    grid->tree().addTile(1, openvdb::Coord(128, 64, 64), -1.0F, active);
    const MeshReport mixed = reportOf(grid);
    expectClosedSolid(mixed, 2);
    EXPECT_EQ(mixed.quads, 6u * 128 * 128 + 4u * 8 * 8);
  }
}

TEST_F(GridSourceTest, AHugeTileThatBordersOnItsLikeCostsNothing) {
  auto grid = sphere(10);
  // Outside tile with the outside sign: no surface on it, so no block either.
  grid->tree().addTile(3, openvdb::Coord(8192, 0, 0), 3.0F, true);
  const GridSource source(grid);
  EXPECT_LT(source.surfaceBlocks({}).coords.size(), 100u);
}

TEST_F(GridSourceTest, BackgroundInsideIsClosedAroundTheOutside) {
  // A bubble: outside only within the ball, everything else is inside.
  auto grid = sphere(8);
  for (auto it = grid->beginValueAll(); it; ++it) it.setValue(-*it);
  grid->tree().root().setBackground(-3.0F, /*updateChildNodes=*/false);
  const MeshReport r = reportOf(grid, {.inside = InsideValues::kLow});
  EXPECT_EQ(r.boundaryEdges, 0u);
  EXPECT_EQ(r.nonManifoldEdges, 0u);
  EXPECT_EQ(r.eulerNumber, 2);
  EXPECT_NEAR(r.volume / sphereVolume(8), -1, 0.02);
}

/// A level set of a ball cut off by a box, as clipping leaves it: background beyond.
FloatGrid::Ptr clippedSphere() {
  auto grid = sphere(12, openvdb::Vec3f(0));
  for (auto it = grid->beginValueOn(); it; ++it)
    if (it.getCoord().x() > 5) it.setValueOff();
  grid->pruneGrid();
  return grid;
}

TEST_F(GridSourceTest, OpenMeansActiveCellsOnly) {
  const auto grid = clippedSphere();
  ContourReport report;
  const MeshReport r = analyze(contour(GridSource(grid, {.open = true}), {}, &report));
  EXPECT_GT(r.boundaryEdges, 20u);
  EXPECT_EQ(r.boundaryEdges, report.boundaryEdges);
  EXPECT_EQ(r.nonManifoldEdges, 0u);
  EXPECT_EQ(r.nonManifoldVertices, 0u);
  EXPECT_EQ(r.misorientedEdges, 0u);
  EXPECT_EQ(r.unusedVertices, 0u);
  EXPECT_EQ(r.eulerNumber, 1);
  EXPECT_LE(r.bounds.hi.x, 5);
  EXPECT_EQ(reportOf(grid).boundaryEdges, 0u);
}

TEST_F(GridSourceTest, OpenAndClosedAgreeOnAWholeSphere) {
  const auto grid = sphere(15);
  const Mesh closed = contour(GridSource(grid)), open = contour(GridSource(grid, {.open = true}));
  EXPECT_EQ(closed.quads, open.quads);
  EXPECT_EQ(closed.positions, open.positions);
}

TEST_F(GridSourceTest, TransformsReachTheMesh) {
  openvdb::math::Mat4d shear = openvdb::math::Mat4d::identity();
  shear(0, 1) = 0.4;
  openvdb::math::Mat4d rotation = openvdb::math::Mat4d::identity();
  rotation.setToRotation(openvdb::Vec3d(1, 2, 3).unit(), 0.7);
  openvdb::math::Mat4d uneven = openvdb::math::Mat4d::identity();
  uneven.preScale(openvdb::Vec3d(1, 2, 5));
  openvdb::math::Mat4d mirror = openvdb::math::Mat4d::identity();
  mirror.preScale(openvdb::Vec3d(-1, 1, 1));
  openvdb::math::Mat4d mirrorAll = openvdb::math::Mat4d::identity();
  mirrorAll.preScale(openvdb::Vec3d(-0.5, -0.5, -0.5));
  openvdb::math::Mat4d moved = openvdb::math::Mat4d::identity();
  moved.setTranslation(openvdb::Vec3d(1000, -2000, 3000));
  const double indexVolume = sphereVolume(30);
  for (const openvdb::math::Mat4d& m : {shear, rotation, uneven, mirror, mirrorAll, moved}) {
    auto grid = sphere(30);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(m));
    const GridSource source(grid);
    const Mesh mesh = contour(source, {.normals = true});
    const MeshReport r = analyze(mesh);
    expectClosedSolid(r, 2);
    EXPECT_NEAR(r.volume / (indexVolume * std::abs(m.getMat3().det())), 1, 2e-3) << m;
    // Normals are those of the transformed sphere: the inverse transpose of the map applied to the radius.
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Vec3f p = mesh.positions[i];
      const openvdb::Vec3d x =
          grid->transform().worldToIndex(openvdb::Vec3d(p.x, p.y, p.z)) - openvdb::Vec3d(0.3, -0.2, 0.1);
      const openvdb::Vec3d n = grid->transform().baseMap()->applyIJT(x).unit();
      EXPECT_GT(n.dot(openvdb::Vec3d(mesh.normals[i].x, mesh.normals[i].y, mesh.normals[i].z)),
                std::cos(2.0 * kPi / 180));
    }
  }
}

TEST_F(GridSourceTest, AMirroredGridGivesTheMirroredMesh) {
  auto grid = sphere(9);
  const Mesh plain = contour(GridSource(grid));
  openvdb::math::Mat4d mirror = openvdb::math::Mat4d::identity();
  mirror.preScale(openvdb::Vec3d(-1, 1, 1));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(mirror));
  const Mesh mirrored = contour(GridSource(grid));
  ASSERT_EQ(mirrored.positions.size(), plain.positions.size());
  for (std::size_t i = 0; i < plain.positions.size(); ++i)
    ASSERT_LT(length(mirrored.positions[i] - Vec3f{-plain.positions[i].x, plain.positions[i].y, plain.positions[i].z}),
              1e-5F);
}

TEST_F(GridSourceTest, FrustumsAreFollowed) {
  constexpr double kSize = 40;
  const auto transform = openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(kSize)), 0.5, 2.0, 1.0);
  auto grid = sphere(12, openvdb::Vec3f(20));
  const double indexVolume = sphereVolume(12);
  grid->setTransform(transform);
  const GridSource source(grid);
  EXPECT_FALSE(source.map().affine());
  const MeshReport r = reportOf(grid);
  expectClosedSolid(r, 2);
  // The sphere's image has the volume of the Jacobian's integral over the ball.
  double jacobian = 0;
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> u(-12, 12);
  int n = 0;
  while (n < 20'000) {
    const Vec3d p{u(engine), u(engine), u(engine)};
    if (length(p) > 12) continue;
    jacobian += std::abs(source.map().jacobian(p + Vec3d{20, 20, 20}).determinant());
    ++n;
  }
  EXPECT_NEAR(r.volume / (indexVolume * jacobian / n), 1, 0.02);
}

TEST_F(GridSourceTest, AFrustumsVoxelIsMeasuredAtTheCentreOfTheData) {
  // The lines of sight meet at the origin of the lattice, where voxels have no volume.
  const auto transform = openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd(openvdb::Vec3d(0, 0, 20), openvdb::Vec3d(40, 40, 40)), 0.5, 2.0, 1.0);
  const auto grid = cubeGrid<FloatGrid>(22, 36, 1.0F, [](int x, int y, int z) {
    return static_cast<float>(length(Vec3d{x - 28.9, y - 28.9, z - 28.9}) - 5);
  });
  grid->setTransform(transform);
  const GridSource source(grid);
  const double volume = std::abs(source.map().jacobian({29, 29, 29}).determinant());
  EXPECT_NEAR(source.map().voxelSize() / std::cbrt(volume), 1, 1e-9);
  expectClosedSolid(analyze(contour(source)), 2);
}

TEST_F(GridSourceTest, NonFiniteVoxelsAreNamedOrAccepted) {
  auto grid = sphere(10, openvdb::Vec3f(0));
  grid->tree().setValueOn(openvdb::Coord(9, 0, 0), std::numeric_limits<float>::quiet_NaN());
  grid->tree().setValueOn(openvdb::Coord(0, 9, 0), std::numeric_limits<float>::infinity());
  grid->tree().setValueOn(openvdb::Coord(-10, 0, 0), -std::numeric_limits<float>::infinity());
  try {
    (void)contour(GridSource(grid));
    FAIL() << "accepted";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("3 voxels are not finite, the first at (-10, 0, 0) is -inf"),
              std::string::npos)
        << e.what();
  }
  const Mesh mesh = contour(GridSource(grid, {.acceptNonFinite = true}));
  const MeshReport r = analyze(mesh);
  expectClosedSolid(r, 2);
  EXPECT_EQ(r.nonFiniteVertices, 0u);
  EXPECT_NEAR(r.volume / sphereVolume(10), 1, 0.02);
}

TEST_F(GridSourceTest, VoxelsThatAreNotFiniteAreOutsideWhateverTheirSign) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float value : {kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
    auto grid = sphere(10, openvdb::Vec3f(0));
    const std::size_t quads = analyze(contour(GridSource(grid))).quads;
    grid->tree().setValueOn(openvdb::Coord(20, 20, 20), value);
    EXPECT_EQ(analyze(contour(GridSource(grid, {.acceptNonFinite = true}))).quads, quads) << "alone, far away";
    grid->tree().addTile(1, openvdb::Coord(64, 64, 64), value, true);
    EXPECT_EQ(analyze(contour(GridSource(grid, {.acceptNonFinite = true}))).quads, quads) << "a tile";
    grid->tree().setValueOn(openvdb::Coord(0, 0, 0), value);
    EXPECT_EQ(analyze(contour(GridSource(grid, {.acceptNonFinite = true}))).quads, quads + 6) << "a cavity";
  }
}

TEST_F(GridSourceTest, TilesThatAreNotFiniteAreRefusedTheBackgroundIsNot) {
  auto grid = sphere(10, openvdb::Vec3f(0));
  grid->tree().addTile(1, openvdb::Coord(64, 64, 64), std::numeric_limits<float>::infinity(), false);
  EXPECT_THROW((void)contour(GridSource(grid)), Error);
  auto one = FloatGrid::create(std::numeric_limits<float>::infinity());
  one->tree().addTile(1, openvdb::Coord(0, 0, 0), -1, true);
  const GridSourceOptions solid{
      .hermite = HermiteMode::kGradient, .gridClass = GridClass::kLevelSet, .inside = InsideValues::kLow};
  EXPECT_FALSE(contour(GridSource(one, solid)).empty());
}

TEST_F(GridSourceTest, RefusesIndicesThatWouldOverflow) {
  auto grid = FloatGrid::create(1.0F);
  grid->tree().setValueOn(openvdb::Coord(std::numeric_limits<int>::max() - 3, 0, 0), -1.0F);
  EXPECT_THROW((void)contour(GridSource(grid)), Error);
}

TEST_F(GridSourceTest, NothingInNothingOut) {
  EXPECT_TRUE(contour(GridSource(FloatGrid::create(1.0F))).empty());
  auto one = FloatGrid::create(1.0F);
  one->tree().setValueOn(openvdb::Coord(0, 0, 0), -1.0F);
  const MeshReport r = reportOf(one);
  expectClosedSolid(r, 2);
  EXPECT_EQ(r.quads, 6u);
}

TEST_F(GridSourceTest, ValuesOnTheIsovalueAreOutside) {
  // A plateau of exact zeros around one negative voxel.
  const auto grid =
      cubeGrid<FloatGrid>(-4, 4, 1.0F, [](int x, int y, int z) { return x == 0 && y == 0 && z == 0 ? -1.0F : 0.0F; });
  const MeshReport r = reportOf(grid);
  expectClosedSolid(r, 2);
  EXPECT_EQ(r.quads, 6u);
  EXPECT_TRUE(contour(GridSource(cubeGrid<FloatGrid>(-4, 4, 0.0F, [](int, int, int) { return 0.0F; }))).empty());
}

}  // namespace
}  // namespace pdc
