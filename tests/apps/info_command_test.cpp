#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/grid_files.h"
#include "apps/program.h"
#include "folders.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

Json infoOf(const std::string& file) {
  const Outcome outcome = runPdc({"info", file, "--json", "-"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  return Json::parse(outcome.out);
}

// A tetrahedron whose faces point outwards.
const std::string kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(InfoCommand, GridFacts) {
  const Json facts = infoOf(bulletGrid());
  EXPECT_EQ(facts["kind"], "grids");
  ASSERT_EQ(facts["grids"].size(), 1U);
  const Json& grid = facts["grids"][0];
  EXPECT_EQ(grid["name"], "surface");
  EXPECT_EQ(grid["value_type"], "float");
  EXPECT_EQ(grid["class"], "level set");
  EXPECT_EQ(grid["active_voxels"], 49680);
  EXPECT_NEAR(grid["voxel_size"][0], 0.005, 1e-9);
  EXPECT_NEAR(grid["background"], 0.015, 1e-8);
  EXPECT_NEAR(grid["value_min"], -0.0149928, 1e-7);
}

TEST(InfoCommand, ListsAllGrids) {
  const TemporaryFolder folder;
  writeSphere(folder / "two.vdb", {.twoGrids = true});
  const Json facts = infoOf(folder / "two.vdb");
  ASSERT_EQ(facts["grids"].size(), 2U);
  EXPECT_EQ(facts["grids"][1]["contourable"], true);
  writeSphere(folder / "vector.vdb", {.vectorGrid = true});
  EXPECT_EQ(infoOf(folder / "vector.vdb")["grids"][0]["contourable"], false);
}

TEST(InfoCommand, MeshFacts) {
  const TemporaryFolder folder;
  const Json facts = infoOf(folder.write("tetrahedron.obj", kTetrahedron));
  EXPECT_EQ(facts["kind"], "mesh");
  EXPECT_EQ(facts["vertices"], 4);
  EXPECT_EQ(facts["triangles"], 4);
  EXPECT_EQ(facts["edges"], 6);
  EXPECT_EQ(facts["euler_number"], 2);
  EXPECT_EQ(facts["components"], 1);
  EXPECT_EQ(facts["boundary_edges"], 0);
  EXPECT_NEAR(facts["volume"], 1.0 / 6.0, 1e-12);
  EXPECT_EQ(facts["bounds_hi"], (Json{1.0, 1.0, 1.0}));
}

TEST(InfoCommand, SaysTheOriginOfAMeshFarAway) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("far.obj", "v 500000.1 4649776.1 0\nv 500000.2 4649776.1 0\nv 500000.1 4649776.2 0\nf 1 2 3\n");
  const Json facts = Json::parse(runPdc({"info", file, "--json", "-"}).out);
  EXPECT_NEAR(facts["origin"][1], 4649776.15, 0.01);
  EXPECT_NEAR(facts["bounds_lo"][1], 4649776.1, 1e-8);
  EXPECT_NEAR(facts["bounds_hi"][1], 4649776.2, 1e-8);
  EXPECT_NEAR(facts["area"], 0.005, 1e-9);
  EXPECT_EQ(facts["warnings"], Json::array());
  const Outcome text = runPdc({"info", file});
  EXPECT_NE(text.out.find("\nbounds hi              500000.2 4649776.2 0\n"), std::string::npos) << text.out;
  const Json near = Json::parse(runPdc({"info", folder.write("near.obj", "v 0 0 0\n"), "--json", "-"}).out);
  EXPECT_FALSE(near.contains("origin"));
}

TEST(InfoCommand, ListsThePropertiesOfVertices) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("rated.ply",
                   "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                   "property uchar rank\nproperty double flow_x\nproperty double flow_y\nend_header\n0 0 0 1 2 3\n");
  EXPECT_EQ(infoOf(file)["properties"], Json::parse(R"([{"name": "rank", "type": "uint8", "components": 1},
                                                        {"name": "flow", "type": "double", "components": 2}])"));
  const std::string text = runPdc({"info", file}).out;
  EXPECT_NE(text.find("name        flow\n  type        double\n  components  2\n"), std::string::npos) << text;
  EXPECT_FALSE(infoOf(folder.write("plain.obj", kTetrahedron)).contains("properties"));
}

TEST(InfoCommand, ReportsBadMeshesWithoutJudging) {
  const TemporaryFolder folder;
  const std::string fan = "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n";
  const Json facts = infoOf(folder.write("fan.obj", fan));
  EXPECT_EQ(facts["non_manifold_edges"], 1);
  EXPECT_EQ(facts["boundary_edges"], 6);
}

std::string triangleAt(double z) { return fmt::format("v 0 0 {0}\nv 1 0 {0}\nv 0 1 {0}\nf 1 2 3\n", z); }

TEST(InfoCommand, ComparesWithAReference) {
  const TemporaryFolder folder;
  const std::string file = folder.write("upper.obj", triangleAt(0.5)),
                    reference = folder.write("lower.obj", triangleAt(0));
  const Outcome outcome = runPdc({"info", file, "--reference", reference, "--samples", "100", "--json", "-"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const Json facts = Json::parse(outcome.out);
  EXPECT_EQ(facts["file"], file);
  EXPECT_EQ(facts["triangles"], 1);
  const Json figures = {{"mean", 0.5}, {"rms", 0.5}, {"p99.9", 0.5}, {"largest", 0.5}, {"samples", 100}};
  EXPECT_EQ(facts["reference"], (Json{{"file", reference},
                                      {"to_reference", figures},
                                      {"from_reference", figures},
                                      {"normal_angle_degrees", {{"mean", 0.0}, {"rms", 0.0}}},
                                      {"opposed_share", 0.0}}));
  EXPECT_FALSE(infoOf(file).contains("reference"));
  const std::string text = runPdc({"info", file, "--reference", reference}).out;
  EXPECT_NE(text.find("\nreference\n  file                  " + reference + "\n  to reference\n    mean     0.5\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\n    samples  1000000\n"), std::string::npos) << text;
}

TEST(InfoCommand, WarningsOfTheReferenceAreShownAndReported) {
  const TemporaryFolder folder;
  const std::string file = folder.write("mesh.obj", triangleAt(0)), reference = folder.write("text.stl", triangleAt(0));
  const Outcome outcome = runPdc({"info", file, "--reference", reference, "--samples", "100", "--json", "-"});
  const Json facts = Json::parse(outcome.out);
  ASSERT_EQ(facts["warnings"].size(), 1U);
  EXPECT_EQ(outcome.err, "pdc: warning: " + facts["warnings"][0].get<std::string>() + "\n");
}

TEST(InfoCommand, ComparesMeshesOnly) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", triangleAt(0)), points = folder.write("points.obj", "v 0 0 0\n");
  const auto refuse = [](const Arguments& arguments, const std::string& mention) {
    expectOneLineRefusal(runPdc(arguments), 1, {mention});
  };
  refuse({"info", mesh, "--reference", bulletGrid()}, "is not the suffix of a mesh");
  refuse({"info", bulletGrid(), "--reference", mesh}, "is not the suffix of a mesh");
  refuse({"info", mesh, "--reference", folder / "none.ply"}, "none.ply: cannot be read");
  refuse({"info", mesh, "--reference", points}, "the reference has no face");
  refuse({"info", points, "--reference", mesh}, "the mesh has no face");
  for (const char* samples : {"0", "-1", "1000000001"})
    refuse({"info", mesh, "--reference", mesh, "--samples", samples}, std::string("--samples is ") + samples);
  expectOneLineRefusal(runPdc({"info", mesh, "--samples", "10"}), 2, {"--reference"});
}

TEST(InfoCommand, SceneFacts) {
  const Json facts = infoOf(sourceFolder() / "scenes/csg.yaml");
  EXPECT_EQ(facts["kind"], "scene");
  for (int axis = 0; axis < 3; ++axis) {
    const double side = facts["box_hi"][axis].get<double>() - facts["box_lo"][axis].get<double>();
    EXPECT_NEAR(facts["cells"][axis].get<double>() * facts["voxel_size"].get<double>(), side,
                facts["voxel_size"].get<double>());
  }
  EXPECT_GT(facts["sigma_n"], 0.0);
}

TEST(InfoCommand, TextIsAligned) {
  const TemporaryFolder folder;
  const Outcome outcome = runPdc({"info", folder.write("tetrahedron.obj", kTetrahedron)});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.out.find("\neuler number           2\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\nnon manifold vertices  0\n"), std::string::npos) << outcome.out;
}

TEST(InfoCommand, JsonFileIsWhatStandardOutputWouldShow) {
  const TemporaryFolder folder;
  const std::string report = folder / "report.json";
  const Outcome outcome = runPdc({"info", bulletGrid(), "--json", report});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(readFile(report), runPdc({"info", bulletGrid(), "--json", "-"}).out);
}

TEST(InfoCommand, BadFilesFailInOneLine) {
  const TemporaryFolder folder;
  const std::array<std::string, 4> files = {folder / "none.ply", folder.write("empty.ply", ""),
                                            folder.write("short.vdb", "x"), folder.write("unknown.xyz", "1 2 3")};
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const Outcome outcome = runPdc({"info", file});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_EQ(runPdc({"info"}).exitCode, 2);
}

TEST(Program, HelpAndVersion) {
  const Outcome version = runPdc({"--version"});
  EXPECT_EQ(version.exitCode, 0);
  EXPECT_EQ(version.out.rfind("pdc 0.", 0), 0U) << version.out;
  for (const Arguments& arguments :
       {Arguments{"--help"}, Arguments{"mesh", "--help"}, Arguments{"info", "--help"}, Arguments{"check", "--help"}}) {
    const Outcome help = runPdc(arguments);
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_NE(help.out.find("Usage: pdc"), std::string::npos) << help.out;
  }
}

}  // namespace
}  // namespace pdc::test
