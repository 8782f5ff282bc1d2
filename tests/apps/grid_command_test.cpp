#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "apps/grid_files.h"
#include "apps/program.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/vdb/vdb_reader.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

TEST(GridCommand, TakesStepsInTheirOrderAndReportsThem) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.vdb", out = folder / "out.vdb", again = folder / "again.vdb";
  writeSphere(in);
  const Arguments steps{"--offset", "0.1", "--clip", "-2,-2,0,2,2,2", "--smooth", "mean:0.1", "--keep", "largest"};
  Arguments line{"grid", in, out, "--json", "-", "--threads", "2"};
  line.insert(line.end(), steps.begin(), steps.end());
  const Outcome outcome = runPdc(line);
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const Json report = Json::parse(outcome.out);
  ASSERT_EQ(report["steps"].size(), 4u);
  EXPECT_EQ(report["steps"][0]["name"], "clip");
  EXPECT_EQ(report["steps"][0]["parameter"], "-2,-2,0,2,2,2");
  EXPECT_EQ(report["steps"][1]["parameter"], "mean:0.1");
  EXPECT_EQ(report["steps"][2]["name"], "offset");
  EXPECT_EQ(report["steps"][3]["parts_after"], 1);
  EXPECT_EQ(report["steps"][3]["voxels_after"], report["active_voxels"]);
  EXPECT_EQ(report["class"], "level set");
  EXPECT_EQ(report["warnings"], Json::array());
  const auto grids = listVdbGrids(out);
  ASSERT_EQ(grids.size(), 1u);
  EXPECT_EQ(grids[0].name, "sphere");
  EXPECT_EQ(grids[0].activeVoxels, report["active_voxels"]);
  line[2] = again;
  line[6] = "1";
  EXPECT_EQ(runPdc(line).exitCode, 0);
  EXPECT_EQ(readFile(out), readFile(again));
}

TEST(GridCommand, MeshTakesTheSameSteps) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.vdb", out = folder / "out.vdb";
  writeSphere(in);
  const Arguments steps{"--clip", "-2,-2,0,2,2,2", "--resample", "0.08", "--offset", "0.1", "--fill-cavities"};
  Arguments both{"grid", in, out, "--quiet"}, one{"mesh", in, folder / "one.ply", "--json", "-"};
  both.insert(both.end(), steps.begin(), steps.end());
  one.insert(one.end(), steps.begin(), steps.end());
  EXPECT_EQ(runPdc(both).err, "");
  EXPECT_EQ(runPdc({"mesh", out, folder / "two.ply", "--quiet"}).err, "");
  const Outcome outcome = runPdc(one);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(Json::parse(outcome.out)["steps"].size(), 4u);
  EXPECT_EQ(readFile(folder / "one.ply"), readFile(folder / "two.ply"));
  EXPECT_EQ(runPdc({"check", folder / "one.ply"}).exitCode, 0);
}

TEST(GridCommand, MeshesAndOtherFilesTakePart) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.vdb", moved = folder / "moved.vdb", mesh = folder / "ball.ply",
                    out = folder / "out.vdb";
  writeSphere(in);
  writeSphere(moved, {.offset = 0.55});
  EXPECT_EQ(runPdc({"mesh", in, mesh, "--quiet"}).exitCode, 0);
  const Outcome outcome = runPdc({"grid", mesh, out, "--mesh-to-level-set", "0.08:0.3", "--union", moved, "--subtract",
                                  in + ":sphere", "--json", "-"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["steps"][0]["name"], "mesh-to-level-set");
  EXPECT_EQ(report["steps"][0]["parameter"], "0.08:0.3");
  EXPECT_EQ(report["steps"][1]["name"], "union");
  EXPECT_EQ(report["steps"][2]["parameter"], in + ":sphere");
  EXPECT_EQ(runPdc({"mesh", mesh, folder / "back.ply", "--mesh-to-level-set", "0.1", "--quiet"}).exitCode, 0);
  EXPECT_GT(readMesh(folder / "back.ply").quads.size(), 500u);
}

TEST(GridCommand, RefusesInOneLineAndWritesNothing) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.vdb", vector = folder / "vector.vdb", out = folder / "out.vdb";
  writeSphere(in);
  writeSphere(vector, {.vectorGrid = true});
  expectOneLineRefusal(runPdc({"grid", in, folder / "out.ply"}), 1, {"out.ply", ".vdb"});
  expectOneLineRefusal(runPdc({"grid", vector, out}), 1, {"vector.vdb", "vec3s"});
  expectOneLineRefusal(runPdc({"grid", in, out, "--offset", "50"}), 1, {"ball.vdb", "offset", "128"});
  expectOneLineRefusal(runPdc({"grid", in, out, "--fog-to-level-set", "0.5"}), 1, {"level set already"});
  expectOneLineRefusal(runPdc({"grid", in, out, "--union", "nothing"}), 1, {"'nothing'", "FILE.vdb"});
  expectOneLineRefusal(runPdc({"grid", in, out, "--clip", "nothing"}), 1, {"no grid \"nothing\""});
  expectOneLineRefusal(runPdc({"grid", in, out, "--clip", "1,2,3"}), 2, {"--clip", "'1,2,3'"});
  expectOneLineRefusal(runPdc({"grid", in, out, "--smooth", "mean"}), 2, {"--smooth", "'mean'"});
  expectOneLineRefusal(runPdc({"grid", in, out, "--keep", "0"}), 2, {"--keep", "'0'"});
  expectOneLineRefusal(runPdc({"mesh", in, folder / "m.ply", "--mesh-to-level-set", "0.1"}), 2, {"meshes"});
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"ball.vdb", "vector.vdb"}));
}

TEST(GridCommand, InfoSaysWhatHelpsToChooseSteps) {
  const TemporaryFolder folder;
  writeSphere(folder / "ball.vdb");
  writeSphere(folder / "hole.vdb", {.floodFilled = false});
  const auto factsOf = [&](const std::string& name) {
    const Outcome outcome = runPdc({"info", folder / name, "--json", "-"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return Json::parse(outcome.out)["grids"][0];
  };
  const Json ball = factsOf("ball.vdb"), hole = factsOf("hole.vdb");
  EXPECT_EQ(ball["read_as"], "level set");
  EXPECT_EQ(ball["inside"], "low");
  EXPECT_NEAR(ball["half_width_voxels"].get<double>(), 3, 0.1);
  EXPECT_NEAR(ball["slope"].get<double>(), 1, 0.01);
  EXPECT_EQ(ball["parts"], 1);
  EXPECT_EQ(ball["cavities"], 0);
  EXPECT_FALSE(ball.contains("doubts"));
  std::size_t sum = 0;
  for (const Json& count : ball["histogram"]) sum += count.get<std::size_t>();
  EXPECT_EQ(sum, ball["active_voxels"].get<std::size_t>());
  EXPECT_EQ(hole["cavities"], 1);
  EXPECT_NE(hole["doubts"].dump().find("false sheet"), std::string::npos);
}

TEST(GridCommand, WarnsWhereNothingIsLeft) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.vdb", out = folder / "out.vdb";
  writeSphere(in);
  const Outcome outcome = runPdc({"grid", in, out, "--clip", "5,5,5,6,6,6"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.err.find("pdc: warning: clip: nothing is left of the grid"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("clip 5,5,5,6,6,6: 0 active voxels"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace pdc::test
