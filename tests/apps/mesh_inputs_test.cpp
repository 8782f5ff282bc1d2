#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/program.h"
#include "mesh/winding/cubes.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

class MeshInputs : public ::testing::Test {
 protected:
  MeshInputs() { static_cast<void>(writeMesh(cube(), mCube)); }

  /// Contours, expects success and a clean mesh, and returns the report on it.
  MeshReport contour(const std::string& input, Arguments more = {}) {
    Arguments arguments{"mesh", input, mOutput, "--json", mJson};
    arguments.insert(arguments.end(), more.begin(), more.end());
    mOutcome = runPdc(arguments);
    EXPECT_EQ(mOutcome.exitCode, 0) << mOutcome.err;
    const Outcome check = runPdc({"check", mOutput});
    EXPECT_EQ(check.exitCode, 0) << check.out;
    mReport = Json::parse(readFile(mJson));
    return analyze(readMesh(mOutput));
  }

  TemporaryFolder mFolder;
  const std::string mCube = mFolder / "cube.stl", mOutput = mFolder / "out.ply", mJson = mFolder / "report.json";
  Outcome mOutcome;
  Json mReport;
};

TEST_F(MeshInputs, CubeKeepsItsVolume) {
  EXPECT_NEAR(contour(mCube, {"--voxel-size", "0.1"}).volume, 1, 1e-4);
  EXPECT_EQ(mReport["hermite"], "triangle");
  EXPECT_EQ(mReport["mesh"]["triangles"], 12);
  EXPECT_EQ(mReport["mesh"]["open_edges"], 0);
  EXPECT_EQ(mReport["mesh"]["voxel_size"], 0.1);
  EXPECT_NE(mOutcome.out.find("12 triangles, closed"), std::string::npos) << mOutcome.out;
}

TEST_F(MeshInputs, ThereAre128VoxelsOrAsManyAsAsked) {
  contour(mCube);
  EXPECT_EQ(mReport["mesh"]["voxel_size"], 1.0 / 128);
  contour(mCube, {"--resolution", "20"});
  EXPECT_EQ(mReport["mesh"]["voxel_size"], 1.0 / 20);
}

TEST_F(MeshInputs, OpenMeshesAreClosedAndSaidToBeOpen) {
  const std::string path = mFolder / "open.off";
  static_cast<void>(writeMesh(openCube(), path));
  EXPECT_GT(contour(path, {"--resolution", "20"}).volume, 0.7);
  EXPECT_EQ(mReport["mesh"]["open_edges"], 4);
  EXPECT_NE(mOutcome.out.find("4 open edges"), std::string::npos) << mOutcome.out;
}

TEST_F(MeshInputs, OffsetsAreTrue) {
  const double d = 0.2;
  const double rounded = 1 + 6 * d + 3 * M_PI * d * d + 4.0 / 3 * M_PI * d * d * d;
  EXPECT_NEAR(contour(mCube, {"--voxel-size", "0.05", "--offset", "0.2"}).volume, rounded, 0.002 * rounded);
  EXPECT_NEAR(contour(mCube, {"--voxel-size", "0.05", "--offset=-0.2"}).volume, 0.6 * 0.6 * 0.6, 1e-4);
}

TEST_F(MeshInputs, ShellsAreHollow) {
  const MeshReport shell = contour(mCube, {"--voxel-size", "0.05", "--shell", "0.2"});
  EXPECT_NEAR(shell.volume, 1 - 0.6 * 0.6 * 0.6, 1e-4);
  EXPECT_EQ(shell.components, 2U);
}

TEST_F(MeshInputs, SelfIntersectingMeshesAreMovedAsTheirSolid) {
  Mesh two = cube();
  addCube(two, {0.5F, 0.25F, 0.125F}, 1);
  const std::string path = mFolder / "two.obj";
  static_cast<void>(writeMesh(two, path));
  const MeshReport shell = contour(path, {"--voxel-size", "0.05", "--shell", "0.1"});
  EXPECT_EQ(shell.components, 2U);
}

TEST_F(MeshInputs, ScenesCombineMeshes) {
  const auto scene = mFolder.write("scene.yaml",
                                   "box: [[-0.5, -0.5, -0.5], [2, 2, 2]]\nvoxel_size: 0.05\n"
                                   "shape:\n  union:\n    - mesh: {file: cube.stl}\n"
                                   "    - translate: {by: [0.5, 0.5, 0.5], of: {mesh: {file: cube.stl}}}\n");
  EXPECT_NEAR(contour(scene.string()).volume, 2 - 0.125, 1e-3);
  EXPECT_EQ(mReport["hermite"], "function");
}

TEST_F(MeshInputs, Refusals) {
  const auto refused = [&](Arguments arguments, int code, const std::vector<std::string>& mentions) {
    arguments.insert(arguments.begin(), {"mesh"});
    arguments.insert(arguments.begin() + 2, mOutput);
    expectOneLineRefusal(runPdc(arguments), code, mentions);
  };
  refused({mCube, "--open"}, 2, {"--open", "grids, volumes and scenes only"});
  refused({mCube, "--iso", "1"}, 2, {"--iso", "only"});
  refused({mCube, "--grid", "a"}, 2, {"--grid", ".vdb inputs only"});
  refused({mCube, "--smooth", "mean:1"}, 2, {"a step on grids but --offset"});
  refused({mCube, "--shell", "0"}, 2, {"--shell"});
  refused({bulletGrid().string(), "--shell", "1"}, 2, {"--shell", "meshes only"});
  refused({mCube, "--voxel-size", "1e-9"}, 1, {"cube.stl", "voxels per axis"});
  refused({mFolder / "none.stl"}, 1, {"none.stl"});
  refused({mFolder.write("empty.off", "OFF\n0 0 0\n").string()}, 1, {"empty.off", "no faces"});
  const auto scene =
      mFolder.write("bad.yaml", "box: [[0, 0, 0], [1, 1, 1]]\nresolution: 4\nshape: {mesh: {file: no.stl}}\n");
  refused({scene.string()}, 1, {"bad.yaml:3", "no.stl"});
}

}  // namespace
}  // namespace pdc::test
