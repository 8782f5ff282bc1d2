#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/program.h"

namespace pdc::test {
namespace {

// A tetrahedron whose vertices have three properties, but no confidence.
const std::string kTetrahedron =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float error\nproperty int clay\nproperty double flow_x\nproperty double flow_y\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 0 -7 1 0\n1 0 0 1 -4 0 -2\n0 1 0 2 -5 3 4\n0 0 1 0.5 -6 nan 0\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

class RenderCommand : public ::testing::Test {
 protected:
  void expectRefusal(Arguments arguments, int exitCode, const std::vector<std::string>& mentions) {
    arguments.insert(arguments.begin(), "render");
    const auto before = mFolder.entries();
    expectOneLineRefusal(runPdc(arguments), exitCode, mentions);
    EXPECT_EQ(mFolder.entries(), before);
  }
  std::string draw(Arguments options) {
    options.insert(options.begin(), {"render", mMesh, mPicture, "--size", "64x48"});
    const Outcome outcome = runPdc(options);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    mSaid = outcome.out;
    return readFile(mPicture);
  }

  TemporaryFolder mFolder;
  std::string mMesh = mFolder.write("mesh.ply", kTetrahedron), mPicture = mFolder / "picture.png";
  std::string mSaid;
};

TEST_F(RenderCommand, MakesAPictureOfTheSizeAskedFor) {
  const std::string bytes = draw({});
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  EXPECT_EQ(bytes.substr(16, 8), std::string("\0\0\0\x40\0\0\0\x30", 8));
  EXPECT_NE(mSaid.find("64 x 48 pixels"), std::string::npos) << mSaid;
  EXPECT_EQ(draw({"--quiet"}), bytes);
  EXPECT_EQ(mSaid, "");
  EXPECT_EQ(draw({"--threads", "1"}), draw({"--threads", "3"}));
}

TEST_F(RenderCommand, OptionsChangeThePicture) {
  const std::string plain = draw({});
  for (const Arguments& options : std::vector<Arguments>{
           {"--view", "front"}, {"--view", "0.5,1,-2"}, {"--shading", "normal"}, {"--shading", "error"}, {"--edges"}})
    EXPECT_NE(draw(options), plain) << options[0];
  EXPECT_EQ(draw({"--view", "iso"}), plain);
  EXPECT_EQ(draw({"--view", "2,-2,2"}), plain);
}

TEST_F(RenderCommand, ErrorIsAPropertyOrTheDistanceToAReference) {
  const std::string property = draw({"--shading", "error"});
  EXPECT_NE(mSaid.find("error from 0, blue, to 2, yellow"), std::string::npos) << mSaid;
  EXPECT_NE(draw({"--shading", "error", "--range", "4"}), property);
  EXPECT_NE(draw({"--shading", "error", "--reference", mMesh}), property);
  EXPECT_NE(mSaid.find("to 0, yellow"), std::string::npos) << mSaid;
}

TEST_F(RenderCommand, AnyPropertyGivesColours) {
  const std::string error = draw({"--shading", "property:error"});
  EXPECT_NE(mSaid.find("error from 0, blue, to 2, yellow"), std::string::npos) << mSaid;
  EXPECT_EQ(error, draw({"--shading", "error"}));
  EXPECT_NE(draw({"--shading", "property:clay"}), draw({"--shading", "clay"}));
  EXPECT_NE(draw({"--shading", "property:clay"}), error);
  EXPECT_NE(mSaid.find("clay from -7, blue, to -4, yellow"), std::string::npos) << mSaid;
  draw({"--shading", "property:flow"});
  EXPECT_NE(mSaid.find("flow from 1, blue, to 5, yellow"), std::string::npos) << mSaid;
}

TEST_F(RenderCommand, BadRequestsFailInOneLine) {
  expectRefusal({mMesh, mPicture, "--view", "sideways"}, 2, {"--view", "'sideways'", "iso, front"});
  expectRefusal({mMesh, mPicture, "--view", "0,0,0"}, 2, {"--view", "'0,0,0'"});
  expectRefusal({mMesh, mPicture, "--view", "1,2"}, 2, {"--view", "'1,2'"});
  for (const char* size : {"0x10", "10", "10x", "1.5x2", "10x9000", "-1x1", "10x10x10"})
    expectRefusal({mMesh, mPicture, std::string("--size=") + size}, 2, {"--size", size, "1 to 8192"});
  expectRefusal({mMesh, mPicture, "--shading", "gold"}, 2, {"--shading", "gold"});
  expectRefusal({mMesh, mPicture, "--shading", "property:"}, 2, {"--shading", "property:NAME"});
  expectRefusal({mMesh, mPicture, "--reference", mMesh}, 2, {"--reference", "--shading error only"});
  expectRefusal({mMesh, mPicture, "--range", "0"}, 2, {"--range", "> 0"});
  expectRefusal({mMesh}, 2, {"OUT"});
}

TEST_F(RenderCommand, BadFilesFailInOneLine) {
  expectRefusal({mFolder / "none.ply", mPicture}, 1, {"none.ply", "No such file"});
  expectRefusal({mMesh, mFolder / "none/picture.png"}, 1, {"none", "No such file"});
  expectRefusal({mMesh, mFolder / "picture.jpg"}, 1, {"picture.jpg", ".png"});
  expectRefusal({mFolder.write("empty.off", "OFF\n1 0 0\n0 0 0\n"), mPicture}, 1, {"empty.off", "no faces"});
  expectRefusal({mFolder.write("nan.off", "OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), mPicture}, 1, {"finite"});
  expectRefusal({mMesh, mPicture, "--shading", "confidence"}, 1, {"mesh.ply", "\"confidence\""});
  expectRefusal({mMesh, mPicture, "--shading", "property:gold"}, 1, {"mesh.ply", "\"gold\""});
  expectRefusal(
      {mFolder.write("plain.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), mPicture, "--shading", "error"}, 1,
      {"plain.off", "\"error\"", "--reference"});
}

TEST_F(RenderCommand, SaysWhatItLeavesOut) {
  const std::string file = mFolder.write("hole.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\nnan 0 0\n3 0 1 2\n3 1 3 2\n");
  const Outcome outcome = runPdc({"render", file, mPicture});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.err.find("1 of 4 vertices are not finite"), std::string::npos) << outcome.err;
}

TEST_F(RenderCommand, UnwritableFolder) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const auto folder = mFolder / "locked";
  std::filesystem::create_directory(folder);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  expectRefusal({mMesh, folder / "picture.png"}, 1, {"locked", "Permission denied"});
}

}  // namespace
}  // namespace pdc::test
