#include "extract/mesh_origin.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "extract/certify/sound_checks.h"
#include "pdc/error.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

/// In metres as surveyors have them, with voxels of a centimetre.
const Vec3d kFar{403000.37, 3604900.81, 1000.13};
constexpr double kRadius = 0.2, kVoxel = 0.01;

class MeshOrigin : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }

  /// A level set of a sphere about kFar.
  static openvdb::FloatGrid::Ptr farSphere() {
    const auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        static_cast<float>(kRadius), openvdb::Vec3f(0), static_cast<float>(kVoxel), 3);
    grid->transform().postTranslate(openvdb::Vec3d(kFar.x, kFar.y, kFar.z));
    return grid;
  }

  static double worstDistance(const Mesh& mesh) {
    double worst = 0;
    for (const Vec3f& p : mesh.positions)
      worst = std::max(worst, std::abs(length(mesh.origin + vecCast<double>(p) - kFar) - kRadius));
    return worst;
  }
};

TEST_F(MeshOrigin, WithOneChosenFarLevelSetsAreSound) {
  const GridSource source(farSphere());
  ContourReport report;
  const Mesh mesh = contour(source, {.origin = std::nullopt}, &report);
  expectSound(mesh, report);
  EXPECT_LT(length(mesh.origin - kFar), kRadius);
  EXPECT_LT(worstDistance(mesh), 0.05 * kVoxel);
  // In the world's own coordinates single precision has steps of 25 voxels.
  EXPECT_GT(worstDistance(contour(source)), kVoxel);
}

TEST_F(MeshOrigin, AGivenOneIsTaken) {
  const Vec3d origin = kFar + Vec3d{0.1, -0.3, 0.2};
  ContourReport report;
  const Mesh mesh = contour(GridSource(farSphere()), {.origin = origin}, &report);
  expectSound(mesh, report);
  EXPECT_EQ(mesh.origin, origin);
  EXPECT_LT(worstDistance(mesh), 0.05 * kVoxel);
}

TEST_F(MeshOrigin, NearSurfacesKeepTheWorlds) {
  const FieldSource source(sphere({1, 2, 3}, 1), {.box = {{-1, 0, 1}, {3, 4, 5}}, .voxelSize = 0.1});
  const Mesh plain = contour(source), chosen = contour(source, {.origin = std::nullopt, .exactSums = true});
  EXPECT_EQ(chosen.origin, Vec3d{});
  EXPECT_EQ(plain.positions, chosen.positions);
  EXPECT_EQ(plain.quads, chosen.quads);
}

TEST_F(MeshOrigin, ExactSumsAreExact) {
  const GridSource source(farSphere());
  for (const std::optional<Vec3d>& origin :
       {std::optional<Vec3d>(), std::optional(kFar + Vec3d{1, 1, 1} * (1.0 / 3))}) {
    ContourReport report;
    const Mesh mesh = contour(source, {.origin = origin, .exactSums = true}, &report);
    expectSound(mesh, report);
    for (const Vec3f& p : mesh.positions)
      for (int axis = 0; axis < 3; ++axis) {
        const double sum = mesh.origin[axis] + double{p[axis]};
        ASSERT_EQ(sum - mesh.origin[axis], double{p[axis]});
      }
    if (origin) {
      EXPECT_LT(length(mesh.origin - *origin), 1e-9);
    }
  }
}

TEST_F(MeshOrigin, FrustaMoveToo) {
  const auto grid = farSphere();
  const auto frustum = openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd(openvdb::Vec3d(-25), openvdb::Vec3d(25)), 0.5, 50, kVoxel);
  grid->setTransform(frustum);
  const GridSource source(grid);
  const Vec3d origin{0.25, -0.5, 1};
  const Mesh plain = contour(source, {.placement = Placement::kFree});
  const Mesh moved = contour(source, {.placement = Placement::kFree, .origin = origin});
  ASSERT_FALSE(plain.empty());
  ASSERT_EQ(plain.positions.size(), moved.positions.size());
  for (std::size_t i = 0; i < plain.positions.size(); ++i)
    ASSERT_LT(length(origin + vecCast<double>(moved.positions[i]) - vecCast<double>(plain.positions[i])), 1e-6);
}

TEST_F(MeshOrigin, OneThatIsNotFiniteIsTheCallersMistake) {
  const FieldSource source(sphere({0, 0, 0}, 1), {.box = {{-2, -2, -2}, {2, 2, 2}}, .voxelSize = 0.5});
  EXPECT_THROW((void)contour(source, {.origin = Vec3d{0, std::numeric_limits<double>::infinity(), 0}}),
               std::invalid_argument);
}

TEST_F(MeshOrigin, OneFromWhichVoxelsCannotBeToldApartIsRefused) {
  const FieldSource source(sphere({0, 0, 0}, 1), {.box = {{-2, -2, -2}, {2, 2, 2}}, .voxelSize = 0.5});
  EXPECT_THROW((void)contour(source, {.origin = Vec3d{0, 1e39, 0}}), Error);
  EXPECT_THROW((void)contour(source, {.origin = Vec3d{0, 1e7, 0}}), Error);
  EXPECT_NO_THROW((void)contour(source, {.origin = Vec3d{0, 1e6, 0}}));
}

}  // namespace
}  // namespace pdc
