#include "pdc/render/camera.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "pdc/error.h"
#include "render/shapes.h"

namespace pdc::test {
namespace {

/// Pixels from the middle of the picture.
Vec3d seen(const Camera& camera, const Vec3d& p) { return camera.axes * (p - camera.center) * camera.pixelsPerUnit; }

TEST(Camera, NamedViewsLookFromWhereTheySay) {
  EXPECT_EQ(viewNamed("front"), (Vec3d{0, -1, 0}));
  EXPECT_EQ(viewNamed("right"), (Vec3d{1, 0, 0}));
  EXPECT_EQ(viewNamed("top"), (Vec3d{0, 0, 1}));
  for (const char* name : {"iso", "back", "left", "bottom"}) EXPECT_TRUE(viewNamed(name)) << name;
  for (const char* name : {"", "Front", "sideways"}) EXPECT_FALSE(viewNamed(name)) << name;
}

// What is right, up and near: for each view the corner of the cube at the picture's upper right, nearest to the viewer.
TEST(Camera, AxesAreAsPeopleExpect) {
  const Mesh mesh = cube();
  const auto check = [&](const char* view, const Vec3d& upperRightNear) {
    const Vec3d p = seen(fitCamera({&mesh, 1}, *viewNamed(view), 100, 100), upperRightNear);
    EXPECT_NEAR(p.x, 46, 1e-9) << view;
    EXPECT_NEAR(p.y, 46, 1e-9) << view;
    EXPECT_NEAR(p.z, 46, 1e-9) << view;
  };
  check("front", {1, -1, 1});
  check("back", {-1, 1, 1});
  check("right", {1, 1, 1});
  check("left", {-1, -1, 1});
  check("top", {1, 1, 1});
  check("bottom", {1, -1, -1});
}

TEST(Camera, ShowsAllMeshesAsLargeAsTheyGo) {
  std::array<Mesh, 2> meshes{cube(), cube()};
  for (Vec3f& p : meshes[1].positions) p = p * 0.5F + Vec3f{10, 0, 0};
  const Camera camera = fitCamera(meshes, *viewNamed("front"), 200, 100);
  EXPECT_NEAR(seen(camera, {-1, 0, 0}).x, -92, 1e-6);
  EXPECT_NEAR(seen(camera, {10.5, 0, 0}).x, 92, 1e-6);
}

TEST(Camera, HeedsTheOriginsOfMeshes) {
  std::array<Mesh, 2> meshes{cube(), cube()};
  meshes[0].origin = {1e9, 1e9, 0};
  meshes[1].origin = {1e9 + 10, 1e9, 0};
  const Camera camera = fitCamera(meshes, *viewNamed("front"), 200, 100);
  EXPECT_NEAR(seen(camera, {1e9 - 1, 0, 0}).x, -92, 1e-4);
  EXPECT_NEAR(seen(camera, {1e9 + 11, 0, 0}).x, 92, 1e-4);
}

TEST(Camera, LeavesOutWhatNoFaceUsesAndWhatIsNotFinite) {
  Mesh mesh = cube();
  mesh.positions.push_back({100, 100, 100});
  mesh.positions.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
  mesh.triangles.push_back({0, 8, 9});
  EXPECT_NEAR(seen(fitCamera({&mesh, 1}, {0, -1, 0}, 100, 100), {1, 0, 1}).x, 46, 1e-9);
}

TEST(Camera, Refusals) {
  const Mesh mesh = cube(), empty;
  EXPECT_THROW(static_cast<void>(fitCamera({&empty, 1}, {0, -1, 0}, 10, 10)), Error);
  EXPECT_THROW(static_cast<void>(fitCamera({&mesh, 1}, {0, 0, 0}, 10, 10)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(fitCamera({&mesh, 1}, {0, std::nan(""), 0}, 10, 10)), std::invalid_argument);
}

}  // namespace
}  // namespace pdc::test
