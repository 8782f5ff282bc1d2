#include "pdc/sample/mesh/mesh_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>

#include "folders.h"
#include "mesh/winding/cubes.h"
#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/mesh/distance.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"

namespace pdc {
namespace {

Mesh contoured(const Mesh& mesh, double voxelSize, int threads = 0) {
  return contour(MeshSource(mesh, {.voxelSize = voxelSize}), {.sigmaNormal = 0, .threads = threads});
}

/// Closed, manifold, turned outwards and without intersections.
void expectSound(const Mesh& mesh) {
  const MeshReport report = analyze(mesh);
  EXPECT_EQ(report.boundaryEdges, 0U);
  EXPECT_EQ(report.nonManifoldEdges, 0U);
  EXPECT_EQ(report.nonManifoldVertices, 0U);
  EXPECT_EQ(report.misorientedEdges, 0U);
  EXPECT_GT(report.volume, 0);
  EXPECT_TRUE(selfIntersections(mesh).pairs.empty());
}

bool sameFaces(const Mesh& a, const Mesh& b) {
  return std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(), b.positions.end()) &&
         a.quads == b.quads && a.triangles == b.triangles;
}

TEST(MeshSource, CubeComesBack) {
  for (const double voxelSize : {0.125, 0.1, 0.0937}) {
    const Mesh mesh = contoured(test::cube(), voxelSize);
    expectSound(mesh);
    const MeshReport report = analyze(mesh);
    EXPECT_EQ(report.eulerNumber, 2);
    EXPECT_NEAR(report.volume, 1, 1e-5);
    EXPECT_NEAR(report.area, 6, 1e-4);
    for (const Vec3f& corner : test::cube().positions) {
      float nearest = 1;
      for (const Vec3f& p : mesh.positions) nearest = std::min(nearest, length(p - corner));
      EXPECT_LT(nearest, 1e-4 * voxelSize);
    }
  }
}

TEST(MeshSource, InsideOutAndTwiceAreTheSame) {
  Mesh twice = test::cube();
  test::addCube(twice, {0, 0, 0}, 1);
  const Mesh mesh = contoured(test::cube(), 0.1);
  EXPECT_TRUE(sameFaces(contoured(test::insideOut(test::cube()), 0.1), mesh));
  EXPECT_TRUE(sameFaces(contoured(twice, 0.1), mesh));
}

TEST(MeshSource, CubesThatOverlapBecomeOne) {
  Mesh two = test::cube();
  test::addCube(two, {0.5F, 0.25F, 0.125F}, 1);
  const Mesh mesh = contoured(two, 0.06);
  expectSound(mesh);
  EXPECT_EQ(analyze(mesh).eulerNumber, 2);
  EXPECT_NEAR(analyze(mesh).volume, 2 - 0.5 * 0.75 * 0.875, 1e-4);
}

TEST(MeshSource, HolesAreClosed) {
  const Mesh mesh = contoured(test::openCube(), 0.05);
  expectSound(mesh);
  const MeshReport report = analyze(mesh);
  EXPECT_EQ(report.eulerNumber, 2);
  // The lid is a sphere's cap inwards or flat, no more: at the middle of the hole the winding number is 1/2.
  EXPECT_GT(report.volume, 0.75);
  EXPECT_LT(report.volume, 1.0001);
  const MeshSource source(test::openCube(), {.voxelSize = 0.05});
  EXPECT_EQ(source.facts().openEdges, 4U);
  EXPECT_EQ(source.facts().triangles, 10U);
}

TEST(MeshSource, FarFromTheOrigin) {
  Mesh far = test::cube();
  far.origin = {1e7, -2e7, 3e6};
  const MeshSource source(far, {.voxelSize = 0.1});
  const Mesh mesh = contour(source, {.sigmaNormal = 0, .origin = far.origin});
  EXPECT_NEAR(analyze(mesh).volume, 1, 1e-4);
  EXPECT_NEAR(analyze(mesh).bounds.lo.x, 1e7, 1e-4);
}

TEST(MeshSource, ThreadsDoNotMatter) {
  Mesh two = test::openCube();
  test::addCube(two, {0.5F, 0.25F, 0.125F}, 1);
  EXPECT_TRUE(sameFaces(contoured(two, 0.04, 1), contoured(two, 0.04, 3)));
}

TEST(MeshSource, Refusals) {
  const auto refuses = [](const Mesh& mesh, double voxelSize, const std::string& part) {
    try {
      const MeshSource source(mesh, {.voxelSize = voxelSize});
    } catch (const Error& error) {
      return std::string(error.what()).find(part) != std::string::npos;
    }
    return false;
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, kInfinity, -kInfinity}) EXPECT_TRUE(refuses(test::cube(), bad, "voxel size"));
  EXPECT_TRUE(refuses(test::cube(), 1e-7, "voxels per axis"));
  EXPECT_TRUE(refuses(Mesh{}, 1, "no triangle"));
  Mesh far = test::cube();
  far.origin = {1e12, 0, 0};
  EXPECT_TRUE(refuses(far, 0.1, "at these coordinates"));
}

TEST(MeshSource, FilesOfPartsKeepTheirShape) {
  const std::filesystem::path folder = test::dataFolder() / "mesh";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  for (const char* name : {"fandisk_13k.off", "cgal_joint.off", "wingnut_cad.obj", "cad_angle_block.stl",
                           "cad_featuretype.stl", "cad_cycloidal_assembly.ply", "plane_holes.obj",
                           "stanford_bun_zipper_res2.ply", "cgal_elephant-with-holes.off"}) {
    SCOPED_TRACE(name);
    const Mesh given = readMesh(folder / name);
    const MeshReport before = analyze(given);
    const Vec3d side = before.bounds.hi - before.bounds.lo;
    const double voxelSize = std::max({side.x, side.y, side.z}) / 48;
    const Mesh mesh = contoured(given, voxelSize);
    expectSound(mesh);
    if (before.boundaryEdges > 0 || before.nonManifoldEdges > 0) continue;
    EXPECT_NEAR(analyze(mesh).volume, before.volume, 0.005 * before.volume);
  }
}

}  // namespace
}  // namespace pdc
