#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "apps/program.h"
#include "folders.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

/// A ball of radius 4 about the middle, half a millimetre a voxel, in the LPS frame.
std::string ball() { return (sourceFolder() / "tests/data/ball.nrrd").string(); }

Json meshOf(const Arguments& arguments) {
  Arguments all{"mesh"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  all.insert(all.end(), {"--json", "-"});
  const Outcome outcome = runPdc(all);
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  return Json::parse(outcome.out);
}

TEST(VolumeCommand, MeshNamesFrameUnitAndFormat) {
  const TemporaryFolder folder;
  const Json report = meshOf({ball(), folder / "a.ply", "--iso", "128"});
  EXPECT_EQ(report["volume"]["format"], "NRRD");
  EXPECT_EQ(report["volume"]["encoding"], "deflate");
  EXPECT_EQ(report["volume"]["size"], Json({24, 24, 24}));
  EXPECT_EQ(report["volume"]["space"], "LPS");
  EXPECT_EQ(report["volume"]["unit"], "mm");
  EXPECT_EQ(report["boundary_edges"], 0);
  EXPECT_NE(readFile(folder / "a.ply").find("comment SPACE=LPS UNIT=mm\n"), std::string::npos);
  EXPECT_EQ(runPdc({"check", folder / "a.ply"}).exitCode, 0);
}

TEST(VolumeCommand, EveryMeshFormatNamesTheFrameAndIsReadBack) {
  const TemporaryFolder folder;
  for (const char* name : {"a.obj", "a.off", "a.stl"}) {
    static_cast<void>(meshOf({ball(), folder / name, "--iso", "128", "--space", "ras"}));
    EXPECT_NE(readFile(folder / name).find("SPACE=RAS UNIT=mm"), std::string::npos) << name;
    EXPECT_EQ(runPdc({"check", folder / name}).exitCode, 0) << name;
  }
  static_cast<void>(meshOf({ball(), folder / "b.stl", "--iso", "128", "--ascii"}));
  EXPECT_TRUE(readFile(folder / "b.stl").starts_with("solid SPACE=LPS UNIT=mm\n"));
  static_cast<void>(meshOf({ball(), folder / "c.stl", "--iso", "128", "--origin", "1,2,3"}));
  EXPECT_NE(readFile(folder / "c.stl").substr(0, 80).find("pdc_origin 1 2 3 SPACE=LPS UNIT=mm"), std::string::npos);
}

TEST(VolumeCommand, TheSameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  static_cast<void>(meshOf({ball(), folder / "1.ply", "--iso", "otsu", "--threads", "1"}));
  static_cast<void>(meshOf({ball(), folder / "4.ply", "--iso", "otsu", "--threads", "4"}));
  EXPECT_EQ(readFile(folder / "1.ply"), readFile(folder / "4.ply"));
}

TEST(VolumeCommand, InfoShowsMapRangeThresholdAndACommand) {
  const TemporaryFolder folder;
  const Outcome outcome = runPdc({"info", ball(), "--json", "-", "--histogram", folder / "h.png"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json facts = Json::parse(outcome.out);
  EXPECT_EQ(facts["kind"], "volume");
  EXPECT_EQ(facts["value_type"], "uint8");
  EXPECT_EQ(facts["value_min"], 0.0);
  EXPECT_EQ(facts["value_max"], 255.0);
  EXPECT_EQ(facts["world_x"], Json({0.5, 0.0, 0.0, -5.75}));
  EXPECT_EQ(facts["histogram"].size(), 16U);
  EXPECT_GT(facts["otsu"], 60.0);
  EXPECT_LT(facts["otsu"], 200.0);
  EXPECT_NE(facts["command"].get<std::string>().find("ball.ply --iso "), std::string::npos);
  EXPECT_TRUE(readFile(folder / "h.png").starts_with("\x89PNG"));
  const Outcome text = runPdc({"info", ball()});
  EXPECT_NE(text.out.find("####"), std::string::npos);
  EXPECT_NE(text.out.find("otsu separation"), std::string::npos);
}

TEST(VolumeCommand, GridWritesAVdbThatContoursAlike) {
  const TemporaryFolder folder;
  const Outcome outcome = runPdc({"grid", ball(), folder / "ball.vdb", "--smooth", "gaussian:0.5", "--iso", "128"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(meshOf({folder / "ball.vdb", folder / "a.ply", "--iso", "128"})["boundary_edges"], 0);
  EXPECT_EQ(runPdc({"check", folder / "a.ply"}).exitCode, 0);
}

TEST(VolumeCommand, SweepTakesVolumes) {
  const TemporaryFolder folder;
  const Outcome outcome = runPdc({"sweep", ball(), folder / "out", "--iso", "100,150"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_FALSE(readFile(folder / "out" / "index.html").empty());
}

TEST(VolumeCommand, RawValuesAndMistakesInTheirLayout) {
  const TemporaryFolder folder;
  const std::string raw = folder.write("a.raw", std::string(32, '\0') + std::string(32, '\7'));
  EXPECT_GT(meshOf({raw, folder / "a.ply", "--raw", "4x4x4:u8", "--spacing", "1,2,3"})["vertices"], 0);
  expectOneLineRefusal(runPdc({"mesh", raw, folder / "b.ply"}), 1, {"a.raw", "--raw"});
  expectOneLineRefusal(runPdc({"mesh", raw, folder / "b.ply", "--raw", "4x4x5:u8"}), 1, {"ends early", "80", "64"});
  expectOneLineRefusal(runPdc({"mesh", raw, folder / "b.ply", "--raw", "4x4:u8"}), 2, {"--raw", "4x4:u8"});
  expectOneLineRefusal(runPdc({"mesh", raw, folder / "b.ply", "--raw", "4x4x4:u8", "--spacing", "1,0,1"}), 2,
                       {"--spacing"});
  expectOneLineRefusal(runPdc({"mesh", raw, folder / "b.ply", "--raw", "4x4x4:u8", "--space", "ras"}), 1,
                       {"does not say which way"});
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"a.ply", "a.raw"}));
}

TEST(VolumeCommand, OptionsOfOtherInputsAreRefused) {
  const TemporaryFolder folder;
  expectOneLineRefusal(runPdc({"mesh", ball(), folder / "b.ply", "--grid", "g"}), 2, {"--grid", ".vdb"});
  expectOneLineRefusal(runPdc({"mesh", ball(), folder / "b.ply", "--attribute", "all"}), 2, {"--attribute"});
  expectOneLineRefusal(runPdc({"mesh", ball(), folder / "b.ply", "--voxel-size", "1"}), 2, {"--voxel-size", "scenes"});
  expectOneLineRefusal(runPdc({"mesh", bulletGrid(), folder / "b.ply", "--spacing", "1,1,1"}), 2, {"--spacing"});
  expectOneLineRefusal(runPdc({"mesh", bulletGrid(), folder / "b.ply", "--iso", "otsu"}), 2, {"--iso otsu"});
  expectOneLineRefusal(runPdc({"info", bulletGrid(), "--histogram", folder / "h.png"}), 2, {"--histogram"});
}

}  // namespace
}  // namespace pdc::test
