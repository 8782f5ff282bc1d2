#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/MeshToVolume.h>

#include <cmath>
#include <random>
#include <vector>

#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

using openvdb::FloatGrid;

class DistanceProbeTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }

  static FloatGrid::Ptr sphere(double noise = 0, double scale = 1) {
    auto grid = openvdb::tools::createLevelSetSphere<FloatGrid>(20, openvdb::Vec3f(0.3F, -0.2F, 0.1F), 1, 3);
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal(0, noise);
    for (auto it = grid->beginValueOn(); it; ++it)
      it.setValue(static_cast<float>(scale * (double{*it} + (noise > 0 ? normal(random) : 0.0))));
    return grid;
  }
};

/// That the grid is contoured with plain gradients.
void expectPlainPath(const openvdb::GridBase::ConstPtr& grid) {
  EXPECT_FALSE(GridSource(grid).usesDistances());
  const Mesh mesh = contour(GridSource(grid)), plain = contour(GridSource(grid, {.hermite = HermiteMode::kGradient}));
  EXPECT_FALSE(mesh.empty());
  EXPECT_EQ(mesh.positions, plain.positions);
  EXPECT_EQ(mesh.quads, plain.quads);
}

TEST_F(DistanceProbeTest, LevelSetsAreDistances) {
  EXPECT_TRUE(GridSource(sphere()).usesDistances());
  EXPECT_LT(GridSource(sphere()).valueNoise(), 0.002);
}

TEST_F(DistanceProbeTest, NoiseIsMeasured) {
  for (const double noise : {0.01, 0.05, 0.1}) {
    const GridSource source(sphere(noise));
    EXPECT_TRUE(source.usesDistances());
    EXPECT_NEAR(source.valueNoise(), noise, 0.1 * noise);
  }
}

/// A level set of a mesh whose facets are as large as a voxel, as scanned meshes give: its small kinks are not noise,
/// and nothing to look for creases in.
TEST_F(DistanceProbeTest, RoughSurfacesAreTextureNotNoise) {
  const Mesh rough =
      contour(GridSource(sphere(0.05), {.hermite = HermiteMode::kGradient}), {.sigmaNormal = kPapersSigmaNormal});
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  for (const Vec3f& p : rough.positions) points.emplace_back(p.x, p.y, p.z);
  for (const Quad& q : rough.quads) quads.emplace_back(q[0], q[1], q[2], q[3]);
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  const auto grid = openvdb::tools::meshToLevelSet<FloatGrid>(*transform, points, quads, 3);
  expectPlainPath(grid);
  EXPECT_TRUE(GridSource(grid, {.hermite = HermiteMode::kDistance}).usesDistances());
  EXPECT_EQ(GridSource(grid, {.hermite = HermiteMode::kDistance}).valueNoise(), 0);
}

TEST_F(DistanceProbeTest, TheVoxelSizeDoesNotMatter) {
  const auto grid = openvdb::tools::createLevelSetSphere<FloatGrid>(2, openvdb::Vec3f(0), 0.1F, 3);
  EXPECT_TRUE(GridSource(grid).usesDistances());
  EXPECT_LT(GridSource(grid).valueNoise(), 0.002);
}

TEST_F(DistanceProbeTest, ValuesOfOtherSlopesAreNone) {
  const auto steep = sphere(0, 1.3);
  EXPECT_FALSE(GridSource(steep).usesDistances());
  EXPECT_TRUE(GridSource(steep, {.hermite = HermiteMode::kDistance}).usesDistances());
}

TEST_F(DistanceProbeTest, GradientMeansGradient) {
  EXPECT_FALSE(GridSource(sphere(), {.hermite = HermiteMode::kGradient}).usesDistances());
}

TEST_F(DistanceProbeTest, FogVolumesAreNone) {
  const auto fog = sphere();
  openvdb::tools::sdfToFogVolume(*fog);
  ASSERT_EQ(fog->getGridClass(), openvdb::GRID_FOG_VOLUME);
  expectPlainPath(fog);
}

TEST_F(DistanceProbeTest, WholeNumbersAreNone) {
  const auto grid = openvdb::Int32Grid::create(10);
  for (int x = -8; x <= 8; ++x)
    for (int y = -8; y <= 8; ++y)
      for (int z = -8; z <= 8; ++z)
        grid->tree().setValue({x, y, z}, static_cast<int>(std::lround(std::sqrt(x * x + y * y + z * z))) - 5);
  expectPlainPath(grid);
}

/// Densities as of a scanner: a soft step at the surface, with noise, about a background of air.
TEST_F(DistanceProbeTest, DensitiesAreNone) {
  for (const float background : {-1000.0F, 1000.0F}) {
    const auto grid = FloatGrid::create(background);
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal(0, 30);
    for (int x = -12; x <= 12; ++x)
      for (int y = -12; y <= 12; ++y)
        for (int z = -12; z <= 12; ++z) {
          const double d = std::sqrt(x * x + y * y + z * z) - 8;
          grid->tree().setValue({x, y, z}, static_cast<float>(background * std::tanh(d / 1.5) + normal(random)));
        }
    SCOPED_TRACE(background);
    expectPlainPath(grid);
  }
}

TEST_F(DistanceProbeTest, FrustaAreRefused) {
  const auto grid = sphere();
  grid->setTransform(openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd(openvdb::Vec3d(-30), openvdb::Vec3d(30)), 0.5, 1.0, 1.0));
  EXPECT_FALSE(GridSource(grid).usesDistances());
  EXPECT_THROW(GridSource(grid, {.hermite = HermiteMode::kDistance}), Error);
}

}  // namespace
}  // namespace pdc
