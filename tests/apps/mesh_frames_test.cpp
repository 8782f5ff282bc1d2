#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/grid_files.h"
#include "apps/program.h"
#include "folders.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

/// Balls that move along x, as frames 1, 3, 5 and 7.
class MeshFrames : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const int frame : {1, 3, 5, 7})
      writeSphere(mFolder / ("in.000" + std::to_string(frame) + ".vdb"), {.offset = 0.03 * frame});
  }

  Outcome run(const std::string& frames, Arguments more = {}) {
    more.insert(more.begin(), {"mesh", mFolder / "in.%04d.vdb", mFolder / "out.%d.ply", "--frames", frames});
    return runPdc(more);
  }

  [[nodiscard]] bool made(int frame) const {
    return std::filesystem::exists(mFolder / ("out." + std::to_string(frame) + ".ply"));
  }

  static std::vector<Json> lines(const std::string& text) {
    std::istringstream stream(text);
    std::vector<Json> all;
    for (std::string line; std::getline(stream, line);) all.push_back(Json::parse(line));
    return all;
  }

  TemporaryFolder mFolder;
};

TEST_F(MeshFrames, EachIsTheMeshOfARunOfItsOwn) {
  const Outcome outcome = run("1-7:2", {"--triangles", "--normals"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const std::string frame : {"1", "3", "5", "7"}) {
    const std::string alone = mFolder / "alone.ply";
    ASSERT_EQ(runPdc({"mesh", mFolder / ("in.000" + frame + ".vdb"), alone, "--triangles", "--normals"}).exitCode, 0);
    EXPECT_EQ(readFile(mFolder / ("out." + frame + ".ply")), readFile(alone));
    EXPECT_NE(outcome.out.find("frame " + frame + ": "), std::string::npos);
  }
}

TEST_F(MeshFrames, MissingOnesAreWarnedOf) {
  const Outcome outcome = run("3-6", {"--json", mFolder / "report.ndjson", "--quiet"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "pdc: warning: frame 4: '" + (mFolder / "in.0004.vdb").string() +
                             "' is not there\npdc: warning: frame 6: '" + (mFolder / "in.0006.vdb").string() +
                             "' is not there\n");
  const std::vector<Json> reports = lines(readFile(mFolder / "report.ndjson"));
  ASSERT_EQ(reports.size(), 4u);
  EXPECT_GT(reports[0]["vertices"], 1000);
  EXPECT_EQ(reports[1]["missing"], true);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(reports[i]["frame"], 3 + i);
  EXPECT_FALSE(made(1));
  const Outcome none = run("8");
  EXPECT_EQ(none.exitCode, 1);
  EXPECT_NE(none.err.find("no frame is there"), std::string::npos) << none.err;
}

TEST_F(MeshFrames, AFailureSparesTheOthersAndIsToldAtTheEnd) {
  static_cast<void>(mFolder.write("in.0003.vdb", "damaged"));
  const Outcome outcome = run("1-7:2", {"--json", "-"});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_TRUE(made(1) && !made(3) && made(5) && made(7));
  EXPECT_NE(outcome.err.find("pdc: frame 3: "), std::string::npos) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("pdc: 1 of 4 frames failed\n")) << outcome.err;
  const std::vector<Json> reports = lines(outcome.out);
  ASSERT_EQ(reports.size(), 4u);
  EXPECT_NE(reports[1]["error"].get<std::string>().find("in.0003.vdb"), std::string::npos);
}

TEST_F(MeshFrames, BadPatternsAndRangesAreRefusedInOneLine) {
  const auto before = mFolder.entries();
  const auto refuse = [&](const std::string& input, const std::string& output, const std::string& frames,
                          const std::vector<std::string>& mentions) {
    expectOneLineRefusal(runPdc({"mesh", mFolder / input, mFolder / output, "--frames=" + frames}), 2, mentions);
    EXPECT_EQ(mFolder.entries(), before);
  };
  refuse("in.0001.vdb", "out.%d.ply", "1-3", {"INPUT", "no place for a frame's number", "%04d"});
  refuse("in.%04d.vdb", "out.ply", "1-3", {"OUTPUT", "no place for a frame's number"});
  refuse("in.%04d.%d.vdb", "out.%d.ply", "1-3", {"INPUT", "more than one place"});
  refuse("in.%s.vdb", "out.%d.ply", "1-3", {"INPUT", "no place for a frame's number"});
  for (const std::string range : {"", "3-1", "a", "1-", "-1-3", "1-3:0", "1-3:x", "1-3-5", "1 - 3"})
    refuse("in.%04d.vdb", "out.%d.ply", range, {"--frames"});
  refuse("in.%04d.vdb", "out.%d.ply", "0-2000000", {"--frames", "1000000"});
}

TEST_F(MeshFrames, StopAtOnceAndLeaveNothingHalfWritten) {
  static_cast<void>(mFolder.write("large.1.yaml", readFile(sourceFolder() / "scenes/csg.yaml")));
  static_cast<void>(mFolder.write("large.2.yaml", readFile(sourceFolder() / "scenes/csg.yaml")));
  const auto before = mFolder.entries();
  const Outcome outcome = runPdc({"mesh", mFolder / "large.%d.yaml", mFolder / "large.%d.ply", "--frames", "1-2",
                                  "--quiet", "--resolution", "4000"},
                                 {.interruptAfter = 0.3});
  EXPECT_EQ(outcome.exitCode, 130);
  EXPECT_LT(outcome.secondsAfterSignal, 1.0);
  EXPECT_EQ(outcome.err, "pdc: interrupted\n");
  EXPECT_EQ(mFolder.entries(), before);
}

TEST_F(MeshFrames, ReportsAreThereAsSoonAsTheirFrames) {
  const std::string ball = "shape: {sphere: {radius: 1}}\nbox: [[-2, -2, -2], [2, 2, 2]]\nresolution: ";
  static_cast<void>(mFolder.write("ball.1.yaml", ball + "20\n"));
  static_cast<void>(mFolder.write("ball.3.yaml", ball + "8000\n"));
  const Outcome outcome = runPdc({"mesh", mFolder / "ball.%d.yaml", mFolder / "ball.%d.ply", "--frames", "1-3",
                                  "--quiet", "--json", mFolder / "report.ndjson"},
                                 {.interruptAfter = 1});
  EXPECT_EQ(outcome.exitCode, 130) << outcome.err;
  const std::vector<Json> reports = lines(readFile(mFolder / "report.ndjson"));
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_GT(reports[0]["vertices"], 100);
  EXPECT_EQ(reports[1]["missing"], true);
}

}  // namespace
}  // namespace pdc::test
