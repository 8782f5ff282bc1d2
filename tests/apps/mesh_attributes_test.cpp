#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/program.h"
#include "pdc/io/mesh/mesh_reader.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;
using openvdb::math::Transform;

/// A ball of radius 1, and grids with other transforms: "heat", 300 + x; "flow", staggered; "Cd", colours; "uv", of a
/// type that is no attribute.
class MeshAttributes : public ::testing::Test {
 protected:
  void SetUp() override {
    openvdb::initialize();
    const auto ball = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0F, {0, 0, 0}, 0.1F);
    ball->setName("ball");
    mHeat->setName("heat");
    mHeat->setTransform(Transform::createLinearTransform(0.25));
    mFlow->setName("flow");
    mFlow->setGridClass(openvdb::GRID_STAGGERED);
    mFlow->setTransform(Transform::createLinearTransform(0.3));
    mFlow->transform().postRotate(0.5, openvdb::math::Z_AXIS);
    const auto colours = openvdb::Vec3SGrid::create(openvdb::Vec3s(0.2F, 1, 0));
    colours->setName("Cd");
    const auto pairs = openvdb::createGrid<openvdb::Grid<openvdb::tree::Tree4<openvdb::Vec2s, 5, 4, 3>::Type>>();
    pairs->setName("uv");
    using Pairs = openvdb::Grid<openvdb::tree::Tree4<openvdb::Vec2s, 5, 4, 3>::Type>;
    if (!Pairs::isRegistered()) Pairs::registerGrid();
    for (openvdb::Coord c(-6); c.x() <= 6; ++c.x())
      for (c.y() = -6; c.y() <= 6; ++c.y())
        for (c.z() = -6; c.z() <= 6; ++c.z()) {
          mHeat->tree().setValue(c, 300 + 0.25F * static_cast<float>(c.x()));
          mFlow->tree().setValue(c, openvdb::Vec3s(c.asVec3s()) * 0.5F);
        }
    openvdb::io::File file(mInput);
    file.write(openvdb::GridCPtrVec{ball, mHeat, mFlow, colours, pairs});
  }

  Outcome mesh(const std::string& output, Arguments more) {
    more.insert(more.begin(), {"mesh", mInput, output, "--grid", "ball"});
    return runPdc(more);
  }

  openvdb::FloatGrid::Ptr mHeat = openvdb::FloatGrid::create();
  openvdb::Vec3SGrid::Ptr mFlow = openvdb::Vec3SGrid::create();
  TemporaryFolder mFolder;
  std::string mInput = mFolder / "in.vdb", mOutput = mFolder / "out.ply";
};

TEST_F(MeshAttributes, AreWhatTheGridsHoldAtTheVerticesThatAreLeft) {
  for (const bool adaptive : {false, true}) {
    Arguments arguments{"--attribute", "heat,flow,Cd", "--json", "-"};
    if (adaptive) arguments.insert(arguments.end(), {"--adaptive", "0.2v"});
    const Outcome outcome = mesh(mOutput, arguments);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json properties = Json::parse(outcome.out)["properties"];
    EXPECT_EQ(properties.size(), 5u);
    EXPECT_EQ(properties[1], (Json{{"name", "flow"}, {"type", "float"}, {"components", 3}}));
    const Mesh made = readMesh(mOutput);
    const auto heat = made.values<float>("heat"), flow = made.values<float>("flow");
    const auto green = made.values<std::uint8_t>("green");
    ASSERT_EQ(heat.size(), made.positions.size());
    ASSERT_EQ(flow.size(), 3 * made.positions.size());
    ASSERT_EQ(green.size(), made.positions.size());
    const openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> heats(*mHeat);
    const openvdb::tools::GridSampler<openvdb::Vec3SGrid, openvdb::tools::StaggeredBoxSampler> flows(*mFlow);
    for (std::size_t v = 0; v < heat.size(); ++v) {
      const openvdb::Vec3d place(made.positions[v].x, made.positions[v].y, made.positions[v].z);
      ASSERT_EQ(heat[v], heats.wsSample(place));
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(flow[3 * v + k], flows.wsSample(place)[static_cast<int>(k)]);
      ASSERT_EQ(green[v], 255);
    }
  }
  const Outcome drawn =
      runPdc({"render", mOutput, mFolder / "out.png", "--size", "64x64", "--shading", "property:heat"});
  EXPECT_EQ(drawn.exitCode, 0) << drawn.err;
  EXPECT_NE(drawn.out.find("heat from 298.9"), std::string::npos) << drawn.out;
}

TEST_F(MeshAttributes, AllTakesAllOthersAndSaysWhatItPassesOver) {
  const Outcome outcome = mesh(mOutput, {"--attribute", "all"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "pdc: warning: grid \"uv\" of type vec2s is no attribute\n");
  const Mesh made = readMesh(mOutput);
  ASSERT_EQ(made.properties.size(), 5u);
  for (const char* const name : {"heat", "flow", "red", "green", "blue"}) EXPECT_NE(made.property(name), nullptr);
}

TEST_F(MeshAttributes, OtherFormatsHoldColoursOrNothing) {
  const std::string obj = mFolder / "out.obj", stl = mFolder / "out.stl";
  const Outcome outcome = mesh(obj, {"--attribute", "Cd,heat"});
  ASSERT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.err, "pdc: warning: " + obj + ": only .ply, .vtp and .glb files hold heat\n");
  std::istringstream text(readFile(obj));
  std::string line;
  std::getline(text, line);
  std::getline(text, line);
  EXPECT_TRUE(line.starts_with("v ") && line.ends_with(" 0.2 1 0")) << line;
  EXPECT_GT(readMesh(obj).positions.size(), 1000u);
  EXPECT_EQ(mesh(stl, {"--attribute", "Cd,heat"}).err,
            "pdc: warning: " + stl + ": only .ply, .vtp and .glb files hold red, green, blue, heat\n");
}

TEST_F(MeshAttributes, BadOnesAreRefusedInOneLine) {
  const auto refuse = [&](const std::string& names, int exitCode, const std::vector<std::string>& mentions) {
    expectOneLineRefusal(mesh(mOutput, {"--attribute", names}), exitCode, mentions);
    EXPECT_EQ(mFolder.entries(), std::vector<std::string>{"in.vdb"});
  };
  refuse("none", 1, {"in.vdb", "no grid \"none\""});
  refuse("ball", 1, {"'ball'", "the grid itself"});
  refuse("heat,heat", 1, {"'heat'", "twice"});
  refuse("uv", 1, {"\"uv\"", "vec2s", "vec3i can"});
  refuse("heat,", 2, {"--attribute", "empty name"});
  expectOneLineRefusal(runPdc({"mesh", "any.yaml", mOutput, "--attribute", "a"}), 2,
                       {"--attribute", ".vdb inputs only"});
}

}  // namespace
}  // namespace pdc::test
