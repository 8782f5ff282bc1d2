// Every bad request and every bad file: the exit code, one line that names the trouble, and nothing left behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/grid_files.h"
#include "apps/program.h"

namespace pdc::test {
namespace {

constexpr int kFailed = 1;
constexpr int kUsage = 2;

// The two lines before the shape.
const std::string kHead = "resolution: 10\nbox: [[-2, -2, -2], [2, 2, 2]]\n";

class MeshErrors : public ::testing::Test {
 protected:
  /// Runs `pdc mesh`, appending `folder/out.ply` unless the arguments name an output themselves.
  void expectRefusal(Arguments arguments, int exitCode, const std::vector<std::string>& mentions) {
    if (arguments.size() < 2 || arguments[1].rfind("--", 0) == 0) arguments.insert(arguments.begin() + 1, mOutput);
    arguments.insert(arguments.begin(), "mesh");
    const auto before = mFolder.entries();
    expectOneLineRefusal(runPdc(arguments), exitCode, mentions);
    EXPECT_EQ(mFolder.entries(), before);
  }
  void expectSceneRefusal(const std::string& scene, const std::vector<std::string>& mentions) {
    expectRefusal({mFolder.write("bad.yaml", scene)}, kFailed, mentions);
  }

  TemporaryFolder mFolder;
  std::string mOutput = mFolder / "out.ply";
  std::string mBullet = bulletGrid();
};

TEST_F(MeshErrors, MissingFile) { expectRefusal({mFolder / "none.vdb"}, kFailed, {"none.vdb", "No such file"}); }

TEST_F(MeshErrors, FolderAsInput) {
  std::filesystem::create_directory(mFolder / "folder.vdb");
  expectRefusal({mFolder / "folder.vdb"}, kFailed, {"folder.vdb"});
}

TEST_F(MeshErrors, EmptyFile) { expectRefusal({mFolder.write("empty.vdb", "")}, kFailed, {"empty.vdb"}); }

TEST_F(MeshErrors, NotAVdbFile) {
  expectRefusal({mFolder.write("text.vdb", std::string(5000, 'x'))}, kFailed, {"text.vdb"});
}

TEST_F(MeshErrors, TruncatedAnywhere) {
  const std::string whole = readFile(mBullet);
  ASSERT_GT(whole.size(), 200000U);
  for (const std::size_t size :
       {std::size_t{1}, std::size_t{20}, std::size_t{500}, whole.size() / 2, whole.size() - 1}) {
    SCOPED_TRACE(size);
    expectRefusal({mFolder.write("short.vdb", whole.substr(0, size))}, kFailed, {"short.vdb"});
  }
}

// A flipped bit need not be noticed (values carry no checksum), but the program must end in order: a mesh or one line.
TEST_F(MeshErrors, FlippedBits) {
  const std::string whole = readFile(mBullet);
  int refused = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    std::string flipped = whole;
    const std::size_t place = i < 20 ? 7 * i : i * 7919 % whole.size();
    flipped[place] = static_cast<char>(flipped[place] ^ (1 << i % 8));
    const Outcome outcome = runPdc({"mesh", mFolder.write("flipped.vdb", flipped), mOutput, "--nan", "outside"});
    SCOPED_TRACE(place);
    ASSERT_TRUE(outcome.exitCode == 0 || outcome.exitCode == kFailed) << outcome.exitCode << outcome.err;
    ASSERT_EQ(std::filesystem::exists(mOutput), outcome.exitCode == 0);
    if (outcome.exitCode == kFailed) {
      ++refused;
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    std::filesystem::remove(mOutput);
  }
  EXPECT_GT(refused, 0);
}

TEST_F(MeshErrors, VectorGrid) {
  writeSphere(mFolder / "vector.vdb", {.vectorGrid = true});
  expectRefusal({mFolder / "vector.vdb"}, kFailed, {"velocity", "vec3s"});
}

TEST_F(MeshErrors, UnknownGridName) { expectRefusal({mBullet, "--grid", "density"}, kFailed, {"density", "surface"}); }

TEST_F(MeshErrors, SeveralGridsWithoutAName) {
  writeSphere(mFolder / "two.vdb", {.twoGrids = true});
  expectRefusal({mFolder / "two.vdb"}, kFailed, {"sphere", "other"});
}

TEST_F(MeshErrors, NonFiniteVoxels) {
  writeSphere(mFolder / "nan.vdb", {.nanVoxels = 3, .infiniteVoxels = 2});
  expectRefusal({mFolder / "nan.vdb"}, kFailed, {"5 voxels", "first at (-10, ", "--nan outside"});
}

TEST_F(MeshErrors, FunctionsThatAreNotFinite) {
  expectSceneRefusal(kHead + "shape: {formula: {expression: \"sqrt(x) - 0.5\"}}\n",
                     {"values at lattice points", "the first at (-2, -2, -2) is nan", "--nan outside"});
}

TEST_F(MeshErrors, NoSurfaceWhereOneIsRequired) {
  expectRefusal({mBullet, "--iso", "7", "--require-surface"}, kFailed,
                {"iso 7", "-0.0149928 to 0.015", "mesh is empty"});
}

TEST_F(MeshErrors, MissingScene) { expectRefusal({mFolder / "none.yaml"}, kFailed, {"none.yaml", "No such file"}); }

// The place is LINE:COLUMN of the text that is wrong.
TEST_F(MeshErrors, SceneWithUnknownKey) {
  expectSceneRefusal(kHead + "shape: {sphere: {radius: 1, colour: red}}\n", {"bad.yaml:3:29:", "colour"});
  expectSceneRefusal(kHead + "shape: {blob: {radius: 1}}\n", {"bad.yaml:3:9:", "blob"});
  expectSceneRefusal(kHead + "shape: {sphere: {radius: 1}}\nlight: 3\n", {"bad.yaml:4:1:", "light"});
}

TEST_F(MeshErrors, SceneWithMissingParameter) {
  expectSceneRefusal(kHead + "shape: {sphere: {center: [0, 0, 0]}}\n", {"bad.yaml:3:", "radius"});
  expectSceneRefusal(kHead, {"bad.yaml:", "shape"});
}

TEST_F(MeshErrors, SceneWithNegativeRadius) {
  expectSceneRefusal(kHead + "shape: {sphere: {radius: -1}}\n", {"bad.yaml:3:26:", "-1"});
  expectSceneRefusal(kHead + "shape: {sphere: {radius: .nan}}\n", {"bad.yaml:3:26:", "nan"});
}

TEST_F(MeshErrors, SceneWithEmptyBox) {
  expectSceneRefusal("resolution: 10\nbox: [[-2, -2, 2], [2, 2, 2]]\nshape: {sphere: {radius: 1}}\n",
                     {"bad.yaml:2:", "box", "along z"});
}

TEST_F(MeshErrors, SceneThatIsNoYaml) {
  expectSceneRefusal("shape: {sphere: [\n", {"bad.yaml:"});
  expectSceneRefusal("", {"bad.yaml"});
  expectSceneRefusal(std::string(3, '\0'), {"bad.yaml"});
}

TEST_F(MeshErrors, SceneWithFormulaThatDoesNotParse) {
  expectSceneRefusal(kHead + "shape: {formula: {expression: x^2 + }}\n", {"bad.yaml:3:"});
}

TEST_F(MeshErrors, SceneThatNamesAMissingGrid) {
  expectSceneRefusal(kHead + "shape: {grid: {file: none.vdb}}\n", {"none.vdb"});
}

TEST_F(MeshErrors, SceneWithTooManyVoxels) {
  const std::string scene = mFolder.write("fine.yaml", kHead + "shape: {sphere: {radius: 1}}\n");
  expectRefusal({scene, "--voxel-size", "1e-9"}, kFailed, {"1048576", "4000000000 along x"});
}

TEST_F(MeshErrors, OutputFolderMissing) {
  expectRefusal({mBullet, mFolder / "none/out.ply"}, kFailed, {"none", "No such file"});
}

TEST_F(MeshErrors, ReportFolderMissing) {
  expectRefusal({mBullet, mOutput, "--json", mFolder / "none/report.json"}, kFailed, {"none", "No such file"});
}

TEST_F(MeshErrors, UnknownOutputSuffix) { expectRefusal({mBullet, mFolder / "out.stp"}, kFailed, {"out.stp", ".ply"}); }

TEST_F(MeshErrors, UnknownInputSuffix) {
  expectRefusal({mFolder.write("volume.txt", "x")}, kFailed, {"volume.txt", ".vdb", ".yaml", ".stl"});
}

TEST_F(MeshErrors, FullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  std::filesystem::create_symlink("/dev/full", mFolder / "full.ply");
  expectRefusal({mBullet, mFolder / "full.ply"}, kFailed, {"No space left"});
}

TEST_F(MeshErrors, FullStandardOutput) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_EQ(runPdc({"info", mBullet}, {.standardOutput = "/dev/full"}).exitCode, kFailed);
}

TEST_F(MeshErrors, NumbersAreReadStrictly) {
  for (const char* text : {"1e", "nan", "inf", "-inf", "0x1", "1,5", " 1", "1 "}) {
    SCOPED_TRACE(text);
    expectRefusal({mBullet, std::string("--iso=") + text}, kUsage, {"--iso", "finite number"});
  }
  for (const char* text : {"-1", "-0.05", "nan", "-inf", "five"}) {
    SCOPED_TRACE(text);
    expectRefusal({mBullet, std::string("--sigma-n=") + text}, kUsage, {"--sigma-n", text, ">= 0 or inf"});
  }
  for (const char* text : {"-1", "1.5", "9999999999999", "two"}) {
    SCOPED_TRACE(text);
    expectRefusal({mBullet, std::string("--threads=") + text}, kUsage, {"--threads", text, "from 0 to"});
  }
}

TEST_F(MeshErrors, OptionsOfTheOtherKindOfInput) {
  expectRefusal({mBullet, "--voxel-size", "1"}, kUsage, {"--voxel-size", "scenes and meshes only"});
  expectRefusal({mBullet, "--resolution", "10"}, kUsage, {"--resolution", "scenes and meshes only"});
  expectRefusal({"any.yaml", "--grid", "a"}, kUsage, {"--grid", ".vdb inputs only"});
}

TEST_F(MeshErrors, NoiseGridsThatDoNotFit) {
  const std::string input = mFolder / "noise.vdb";
  writeSphere(input, {.noiseGrids = true});
  expectRefusal({input, mOutput, "--grid", "sphere", "--sigma-grid", "none"}, kFailed, {"noise.vdb", "none"});
  expectRefusal({input, mOutput, "--grid", "sphere", "--sigma-grid", "sphere"}, kFailed, {"--sigma-grid", "itself"});
  expectRefusal({input, mOutput, "--grid", "sphere", "--weight-grid", "moved"}, kFailed, {"moved", "transform"});
  expectRefusal({"any.yaml", "--sigma-grid", "a"}, kUsage, {"--sigma-grid", ".vdb inputs only"});
}

TEST_F(MeshErrors, AdaptiveGridsThatDoNotFit) {
  const std::string input = mFolder / "scaled.vdb";
  writeSphere(input, {.noiseGrids = true, .scaleGrids = true});
  const auto refuse = [&](const std::string& name, int exitCode, const std::vector<std::string>& mentions) {
    expectRefusal({input, mOutput, "--grid", "sphere", "--adaptive", "0.1v", "--adaptive-grid", name}, exitCode,
                  mentions);
  };
  refuse("none", kFailed, {"scaled.vdb", "none"});
  refuse("sphere", kFailed, {"--adaptive-grid", "itself"});
  refuse("mask", kFailed, {"mask", "bool", "float or double"});
  refuse("faulty", kFailed, {"the adaptive scale at (", " is -"});
  expectRefusal({input, mOutput, "--grid", "sphere", "--adaptive-grid", "scale"}, kUsage,
                {"--adaptive-grid", "needs --adaptive"});
  expectRefusal({"any.yaml", "--adaptive", "0.1", "--adaptive-grid", "a"}, kUsage,
                {"--adaptive-grid", ".vdb inputs only"});
}

TEST_F(MeshErrors, PropertiesThatTheFormatLacks) {
  expectRefusal({mBullet, mFolder / "out.stl", "--confidence"}, kUsage, {"--confidence", ".ply, .vtp and .glb outputs only"});
  expectRefusal({mBullet, mFolder / "out.obj", "--rank"}, kUsage, {"--rank", ".ply, .vtp and .glb outputs only"});
}

TEST_F(MeshErrors, VoxelSizeAndResolution) {
  expectRefusal({"any.yaml", "--voxel-size", "1", "--resolution", "10"}, kUsage, {"--voxel-size", "--resolution"});
  for (const char* text : {"0", "-1", "inf", "nan"}) {
    expectRefusal({"any.yaml", std::string("--voxel-size=") + text}, kUsage, {"--voxel-size", text, "> 0"});
  }
  for (const char* text : {"0", "-1", "1048577"}) {
    expectRefusal({"any.yaml", std::string("--resolution=") + text}, kUsage,
                  {"--resolution", text, "from 1 to 1048576"});
  }
}

TEST_F(MeshErrors, WrongUsage) {
  expectRefusal({mBullet, "--placement", "anywhere"}, kUsage, {"--placement", "anywhere", "free"});
  expectRefusal({mBullet, "--nan", "inside"}, kUsage, {"--nan", "inside", "outside"});
  expectRefusal({mBullet, "--colour"}, kUsage, {"--colour"});
  expectRefusal({mBullet, mOutput, "third"}, kUsage, {"third"});
  expectRefusal({mBullet, mOutput, "--json", mOutput}, kUsage, {"--json", "OUTPUT"});
  EXPECT_EQ(runPdc({}).exitCode, kUsage);
  EXPECT_EQ(runPdc({"mesh"}).exitCode, kUsage);
  EXPECT_EQ(runPdc({"mash", mBullet}).exitCode, kUsage);
}

}  // namespace
}  // namespace pdc::test
