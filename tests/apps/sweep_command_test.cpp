#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/grid_files.h"
#include "apps/program.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

const std::string kScene = "voxel_size: 0.1\nbox: [[-1, -1, -1], [1, 1, 1]]\nshape: {box: {size: [1.1, 1.1, 1.1]}}\n";
/// A voxel is 0.1, as in the cube's scene.
const std::string kBall = "voxel_size: 0.1\nbox: [[-1, -1, -1], [1, 1, 1]]\nshape: {sphere: {radius: 0.7}}\n";

class SweepCommand : public ::testing::Test {
 protected:
  Json sweep(Arguments options, const std::string& input) {
    options.insert(options.begin(), {"sweep", input, mOut});
    const Outcome outcome = runPdc(options);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    mSaid = outcome.out;
    return Json::parse(readFile(mOut + "/sweep.json"));
  }
  void expectRefusal(Arguments arguments, int exitCode, const std::vector<std::string>& mentions) {
    arguments.insert(arguments.begin(), "sweep");
    expectOneLineRefusal(runPdc(arguments), exitCode, mentions);
    EXPECT_FALSE(std::filesystem::exists(mOut + "/sweep.json"));
  }

  TemporaryFolder mFolder;
  std::string mScene = mFolder.write("cube.yaml", kScene), mOut = mFolder / "out", mSaid;
};

TEST_F(SweepCommand, AGridsWarningsAreSaidOnce) {
  writeSphere(mFolder / "turned.vdb", {.positiveInside = true});
  const std::string input = mFolder / "turned.vdb";
  const Outcome outcome = runPdc({"sweep", input, mOut, "--iso", "0,0.05,0.1"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.err.find("--inside high"), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  sweep({"--iso", "0,0.05,0.1", "--inside", "high"}, input);
}

TEST_F(SweepCommand, MeshesAreThoseOfPdcMesh) {
  const std::string bullet = bulletGrid();
  for (const std::string& input : {mScene, bullet}) {
    sweep({"--sigma-n", "0,0.05,inf", "--meshes"}, input);
    for (const char* sigma : {"0", "0.05", "inf"}) {
      const std::string alone = mFolder / "alone.ply";
      ASSERT_EQ(runPdc({"mesh", input, alone, "--sigma-n", sigma}).exitCode, 0);
      EXPECT_EQ(readFile(mOut + "/sigma_n_" + sigma + ".ply"), readFile(alone)) << input << " " << sigma;
    }
  }
}

TEST_F(SweepCommand, ASurfaceFarFromTheOriginIsMeasuredAsWellAsOneAtIt) {
  // There single precision has steps of four voxels.
  const std::string far = mFolder.write("far.yaml",
                                        "voxel_size: 0.125\nbox: [[8388607, -1, -1], [8388609, 1, 1]]\n"
                                        "shape: {translate: {by: [8388608, 0, 0], of: {sphere: {radius: 0.7}}}}\n");
  for (const Json& step : sweep({"--sigma-n", "0.05,inf"}, far)["steps"]) {
    EXPECT_LT(step["vertex_rms"], 0.05) << step;
    EXPECT_EQ(step["self_intersections"], 0) << step;
  }
}

TEST_F(SweepCommand, ReportsWhatIsKnown) {
  const Json report = sweep({"--sigma-n", "0,inf"}, mScene);
  EXPECT_EQ(report["recommended"], 0);
  EXPECT_EQ(report["steps"].size(), 2u);
  EXPECT_EQ(report["steps"][1]["sigma_n"], "inf");
  EXPECT_GT(report["steps"][1]["crease_rms"], report["steps"][0]["crease_rms"]);
  EXPECT_EQ(report["steps"][0]["euler_number"], 2);
  EXPECT_NE(report["command"].get<std::string>().find("pdc sweep " + mScene), std::string::npos);
  EXPECT_NE(mSaid.find("sigma_n = 0 has the lowest true error"), std::string::npos) << mSaid;
  for (const char* file : {"/sweep.csv", "/index.html"}) EXPECT_GT(readFile(mOut + file).size(), 100u);
  // Nothing is known of a grid, unless a reference says it.
  const std::string bullet = bulletGrid();
  EXPECT_TRUE(sweep({"--sigma-n", "0.05"}, bullet)["steps"][0]["vertex_rms"].is_null());
  const std::string mesh = mFolder / "mesh.ply";
  ASSERT_EQ(runPdc({"mesh", bullet, mesh, "--sigma-n", "0.1"}).exitCode, 0);
  EXPECT_EQ(sweep({"--sigma-n", "0.1,0.2", "--reference", mesh}, bullet)["recommended"], 0.1);
  EXPECT_GT(sweep({"--sigma-n", "0.1", "--reference", mScene}, bullet)["steps"][0]["crease_rms"], 1);
}

TEST_F(SweepCommand, SweepsOverIsoAndVoxelSize) {
  const Json isos = sweep({"--iso", "-0.2,0,0.2", "--quiet"}, mScene);
  EXPECT_EQ(mSaid, "");
  EXPECT_EQ(isos["parameter"], "iso");
  EXPECT_TRUE(isos["recommended"].is_null());
  for (const Json& step : isos["steps"]) EXPECT_LT(step["vertex_rms"], 0.1);
  const Json sizes = sweep({"--voxel-size", "0.2,0.1", "--sigma-n", "0", "--meshes"}, mScene);
  EXPECT_EQ(sizes["parameter"], "voxel_size");
  EXPECT_LT(sizes["steps"][0]["vertices"], sizes["steps"][1]["vertices"]);
  EXPECT_TRUE(std::filesystem::exists(mOut + "/voxel_size_0.2.ply"));
}

TEST_F(SweepCommand, SweepsOverAdaptiveDistances) {
  const std::string ball = mFolder.write("ball.yaml", kBall);
  for (const char* list : {"0,0.05v,0.25v", "0,0.005,0.025"}) {
    const Json report = sweep({"--adaptive", list, "--meshes"}, ball);
    EXPECT_EQ(report["parameter"], "adaptive");
    EXPECT_TRUE(report["recommended"].is_null());
    const Json& steps = report["steps"];
    ASSERT_EQ(steps.size(), 3u);
    EXPECT_TRUE(steps[0]["adapted_max"].is_null());
    EXPECT_EQ(steps[0]["triangles"].get<double>(), 2 * steps[0]["faces"].get<double>());
    for (std::size_t i = 1; i < 3; ++i) {
      EXPECT_NEAR(steps[i]["adaptive"].get<double>(), i == 1 ? 0.05 : 0.25, 1e-12);
      EXPECT_LE(steps[i]["adapted_max"].get<double>(), steps[i]["adaptive"].get<double>() * (1 + 1e-5));
      EXPECT_LT(steps[i]["triangles"], steps[0]["triangles"]);
    }
    EXPECT_NE(readFile(mOut + "/index.html").find("Distance to the full mesh"), std::string::npos);
    EXPECT_NE(readFile(mOut + "/sweep.csv").find("adapted_max"), std::string::npos);
  }
  const std::string alone = mFolder / "alone.ply";
  ASSERT_EQ(runPdc({"mesh", ball, alone, "--sigma-n", "0.05", "--adaptive", "0.25v"}).exitCode, 0);
  EXPECT_EQ(readFile(mOut + "/adaptive_0.25.ply"), readFile(alone));
}

TEST_F(SweepCommand, OtherSweepsMayBeAdaptive) {
  const std::string ball = mFolder.write("ball.yaml", kBall);
  for (const char* distance : {"0.1v", "0.01"}) {
    const Json sizes = sweep({"--voxel-size", "0.2,0.1", "--adaptive", distance}, ball);
    for (const Json& step : sizes["steps"]) {
      const double h = step["voxel_size"], most = distance[3] == 'v' ? 0.1 : 0.01 / h;
      EXPECT_LE(step["adapted_max"].get<double>(), most * (1 + 1e-5)) << step;
    }
  }
  EXPECT_TRUE(sweep({"--iso", "0,0.1", "--adaptive", "0"}, ball)["steps"][0]["adapted_max"].is_null());
}

TEST_F(SweepCommand, AGridSaysHowFineTheFacesAre) {
  const std::string input = mFolder / "scaled.vdb", alone = mFolder / "alone.ply";
  writeSphere(input, {.scaleGrids = true});
  const Arguments scaled{"--grid", "sphere", "--adaptive-grid", "scale"};
  Arguments arguments{"--adaptive", "0,0.3v", "--meshes"}, one{"mesh", input, alone, "--sigma-n", "0.05"};
  arguments.insert(arguments.end(), scaled.begin(), scaled.end());
  one.insert(one.end(), scaled.begin(), scaled.end());
  expectRefusal({input, mOut, "--grid", "sphere", "--adaptive-grid", "scale"}, 2, {"--adaptive-grid", "--adaptive"});
  (void)sweep(arguments, input);
  one.insert(one.end(), {"--adaptive", "0.3v"});
  ASSERT_EQ(runPdc(one).exitCode, 0);
  EXPECT_EQ(readFile(mOut + "/adaptive_0.3.ply"), readFile(alone));
}

TEST_F(SweepCommand, StepsWithoutSurfaceAreBlankButNotAllMayBe) {
  EXPECT_EQ(sweep({"--iso=0,-5"}, mScene)["steps"][1]["faces"], 0);
  std::filesystem::remove_all(mOut);
  expectRefusal({mScene, mOut, "--iso=-5,-6"}, 1, {"cube.yaml", "no surface at any value"});
}

TEST_F(SweepCommand, BadRequestsFailInOneLine) {
  expectRefusal({mScene, mOut, "--sigma-n="}, 2, {"--sigma-n", "LIST missing"});
  for (const char* list : {",", "0,", "0,-0.1", "-1", "nan", "0;1", "a,b", "0, 1", "0,auto"})
    expectRefusal({mScene, mOut, std::string("--sigma-n=") + list}, 2, {"--sigma-n", list, ">= 0 or inf"});
  expectRefusal({mScene, mOut, "--sigma-n", "0.1,0.2,0.1"}, 2, {"--sigma-n", "twice"});
  expectRefusal({mScene, mOut, "--iso=0,inf"}, 2, {"--iso", "finite"});
  expectRefusal({mScene, mOut, "--voxel-size=0,1"}, 2, {"--voxel-size", "> 0"});
  for (const char* list : {",", "0,", "-1", "nan", "inf", "1,v", "1vv", "0,inf"})
    expectRefusal({mScene, mOut, std::string("--adaptive=") + list}, 2, {"--adaptive", list, ">= 0"});
  expectRefusal({mScene, mOut, "--adaptive=0.1v,0.1v"}, 2, {"--adaptive", "twice"});
  expectRefusal({mScene, mOut, "--adaptive=0v,0.1,0.2v"}, 2, {"--adaptive", "mixes"});
  expectRefusal({mScene, mOut, "--adaptive=0,1", "--sigma-n=0,1"}, 2, {"--adaptive", "--sigma-n", "several values"});
  expectRefusal({mScene, mOut, "--iso=0,1", "--sigma-n=0,1"}, 2, {"--iso", "--sigma-n", "several values"});
  expectRefusal({mScene, mOut, "--view", "sideways"}, 2, {"--view", "sideways"});
  expectRefusal({bulletGrid(), mOut, "--voxel-size=1,2"}, 2, {"--voxel-size", "scenes and meshes only"});
  expectRefusal({mScene}, 2, {"OUTDIR"});
}

TEST_F(SweepCommand, BadFilesFailInOneLine) {
  expectRefusal({mFolder / "none.vdb", mOut}, 1, {"none.vdb", "No such file"});
  expectRefusal({mFolder.write("notes.txt", "v 0 0 0\n"), mOut}, 1, {"notes.txt", ".vdb"});
  expectRefusal({mFolder.write("mesh.obj", "v 0 0 0\n"), mOut}, 1, {"mesh.obj", "no faces"});
  expectRefusal({mScene, mFolder / "none/out"}, 1, {"none/out", "No such file"});
  expectRefusal({mScene, mFolder.write("file", "x")}, 1, {"file", "folder"});
  expectRefusal({mScene, mOut, "--reference", mFolder / "none.ply"}, 1, {"none.ply", "No such file"});
  expectRefusal({mScene, mOut, "--reference", mFolder.write("empty.off", "OFF\n1 0 0\n0 0 0\n")}, 1,
                {"empty.off", "no faces"});
}

TEST_F(SweepCommand, UnwritableFolder) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  std::filesystem::create_directory(mOut);
  std::filesystem::permissions(mOut, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  expectRefusal({mScene, mOut}, 1, {"out", "Permission denied"});
}

}  // namespace
}  // namespace pdc::test
