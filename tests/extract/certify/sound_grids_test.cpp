// Grids of all kinds give sound meshes: odd values, thin and small shapes, transforms, real files.

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetPlatonic.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "extract/certify/sound_checks.h"
#include "folders.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

using openvdb::FloatGrid;

class SoundGrids : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }

  static void expectSoundMesh(const FloatGrid::Ptr& grid, double sigma) {
    for (const Placement placement : {Placement::kCertified, Placement::kCell}) {
      ContourReport report;
      const Mesh mesh =
          contour(GridSource(grid, {.acceptNonFinite = true}), {.sigmaNormal = sigma, .placement = placement}, &report);
      ASSERT_FALSE(mesh.empty());
      expectSound(mesh, report);
    }
  }
};

/// Values of a box of lattice points; the background, outside, elsewhere.
FloatGrid::Ptr boxGrid(int size, const std::function<float(int, int, int)>& value, float background = 3) {
  auto grid = FloatGrid::create(background);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto accessor = grid->getAccessor();
  for (int x = 0; x < size; ++x)
    for (int y = 0; y < size; ++y)
      for (int z = 0; z < size; ++z) accessor.setValue({x, y, z}, value(x, y, z));
  return grid;
}

TEST_F(SoundGrids, OddValues) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kTiny = std::numeric_limits<float>::denorm_min(), kHuge = std::numeric_limits<float>::max();
  std::mt19937 engine(5);
  for (const double ordinary : {0.2, 0.8}) {
    std::bernoulli_distribution isOrdinary(ordinary);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const auto value = [&](int, int, int) {
      constexpr std::array kOdd{kInfinity, -kInfinity, kNan, 0.0F, -0.0F, kTiny, -kTiny, kHuge, -kHuge};
      return isOrdinary(engine) ? uniform(engine) : kOdd[engine() % kOdd.size()];
    };
    for (const double sigma : {0.0, 0.05, 1.0}) expectSoundMesh(boxGrid(20, value), sigma);
  }
}

TEST_F(SoundGrids, PlateausOnTheIsovalueAreOutside) {
  // A block of inside in a block of zeros: the surface is the inner block's.
  const auto plateau = [](int x, int y, int z) {
    const int far = std::max({std::abs(x - 6), std::abs(y - 6), std::abs(z - 6)});
    return far <= 2 ? -1.0F : far <= 4 ? 0.0F : 1.0F;
  };
  const auto grid = boxGrid(13, plateau);
  expectSoundMesh(grid, 0.05);
  const MeshReport r = analyze(contour(GridSource(grid)));
  EXPECT_EQ(r.eulerNumber, 2);
  EXPECT_NEAR(r.volume, 6 * 6 * 6, 10) << "crossings lie in the first points that are zero";
}

TEST_F(SoundGrids, OneVoxelAndPlatesOfOneLayer) {
  const auto voxel = [](int x, int y, int z) { return x == 4 && y == 4 && z == 4 ? -0.5F : 0.5F; };
  expectSoundMesh(boxGrid(9, voxel, 0.5F), 0.05);
  EXPECT_EQ(analyze(contour(GridSource(boxGrid(9, voxel, 0.5F)))).vertices, 8u);

  const auto plate = [](int x, int y, int z) { return std::min(z, y) > 1 && x == 5 && z < 9 && y < 9 ? -0.1F : 0.1F; };
  expectSoundMesh(boxGrid(11, plate, 0.1F), 0.05);
  EXPECT_EQ(analyze(contour(GridSource(boxGrid(11, plate, 0.1F)))).eulerNumber, 2);
}

TEST_F(SoundGrids, EdgesPassedTwiceHaveNoFace) {
  // A plate thinner than the spacing of lattice points, between two layers of them.
  const auto between = [](int x, int, int) { return std::abs(static_cast<float>(x) - 4.5F) - 0.2F; };
  EXPECT_TRUE(contour(GridSource(boxGrid(9, between))).empty());
}

FloatGrid::Ptr roughBox(std::mt19937& engine, double noise) {
  std::normal_distribution<double> normal;
  openvdb::math::Quat<double> q(normal(engine), normal(engine), normal(engine), normal(engine));
  q.normalize();
  const openvdb::Mat3d rotation(q);
  return boxGrid(32, [&](int x, int y, int z) {
    const openvdb::Vec3d p = rotation * (openvdb::Vec3d(x, y, z) - openvdb::Vec3d(15.3, 15.7, 15.1));
    const double d =
        std::max({std::abs(p.x()) - 9.2, std::abs(p.y()) - 6.1, std::abs(p.z()) - 4.3}) + noise * normal(engine);
    return static_cast<float>(std::clamp(d, -3.0, 3.0));
  });
}

TEST_F(SoundGrids, RotatedBoxesWithAndWithoutNoise) {
  std::mt19937 engine(6);
  for (int i = 0; i < 12; ++i)
    for (const double sigma : {0.0, 0.01, 0.1, std::numeric_limits<double>::infinity()}) {
      expectSoundMesh(roughBox(engine, std::array{0.0, 0.1, 0.5}[i % 3]), sigma);
      if (HasFailure()) FAIL() << "box " << i << ", sigma " << sigma;
    }
}

TEST_F(SoundGrids, AnyAffineTransform) {
  using openvdb::math::Mat4d;
  Mat4d shear = Mat4d::identity();
  shear(0, 1) = 0.8;
  Mat4d rotation = Mat4d::identity();
  rotation.setToRotation(openvdb::Vec3d(1, 2, 3).unit(), 0.7);
  Mat4d uneven = Mat4d::identity();
  uneven.preScale(openvdb::Vec3d(1, 2, 5));
  Mat4d mirror = rotation;
  mirror.preScale(openvdb::Vec3d(-1, 1, 1));
  Mat4d far = Mat4d::identity();
  far.setTranslation(openvdb::Vec3d(1e6, -1e6, 1e6));
  std::mt19937 engine(7);
  for (const Mat4d& m : {shear, rotation, uneven, mirror, far}) {
    const auto grid = roughBox(engine, 0.2);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(m));
    expectSoundMesh(grid, 0.05);
    if (HasFailure()) FAIL() << m;
  }
}

// The one that comes with the sources, and others where their folder exists.
TEST_F(SoundGrids, RealFiles) {
  std::vector<std::filesystem::path> files{test::sourceFolder() / "tests/data/mpm_bullet.vdb"};
  const std::filesystem::path folder = test::dataFolder() / "vdb";
  if (std::filesystem::exists(folder)) {
    for (const char* name : {"ovdb_icosahedron", "mpm_bullet", "vpt_dragon_affine", "derived_bunny_ls_f32_blosc",
                             "derived_fandisk_ls_half_mask", "derived_wingnut_sdf_zip_unknown", "oiio_sphere_mask"})
      files.push_back(folder / (std::string(name) + ".vdb"));
  } else {
    std::printf("no data at %s: only the grid of the sources is tested\n", folder.c_str());
  }
  for (const std::filesystem::path& file : files) {
    const auto grid = readVdbGrid(file.string());
    for (const double sigma : {0.0, 0.05}) {
      ContourReport report;
      const Mesh mesh = contour(GridSource(grid), {.sigmaNormal = sigma}, &report);
      ASSERT_FALSE(mesh.empty()) << file;
      expectSound(mesh, report);
      if (HasFailure()) FAIL() << file << ", sigma " << sigma;
    }
  }
}

}  // namespace
}  // namespace pdc
