#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "apps/program.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/simplify/decimate.h"
#include "simplify/shapes.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

TEST(DecimateCommand, WritesFewerTrianglesAndAReport) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "small.obj";
  writeMesh(sphere(20), in);
  const Outcome outcome = runPdc({"decimate", in, out, "--ratio", "0.1", "--json", "-", "--threads", "2"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.err, "");
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["faces_before"], 4800);
  EXPECT_EQ(report["faces"], 480);
  EXPECT_EQ(report["vertices"], 242);
  EXPECT_EQ(report["end"], "reached");
  EXPECT_EQ(report["quadric"], "probabilistic-plane");
  EXPECT_EQ(report["warnings"], Json::array());
  EXPECT_EQ(readMesh(out).triangles.size(), 480u);
  EXPECT_EQ(runPdc({"check", out}).exitCode, 0);
}

TEST(DecimateCommand, SaysWhatItDid) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "small.ply";
  writeMesh(sphere(10), in);
  const Outcome outcome =
      runPdc({"decimate", in, out, "--faces", "100", "--quadric", "triangle", "--placement", "subset", "--ascii"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.out.find(": 100 of 1200 triangles, 52 vertices;"), std::string::npos) << outcome.out;
  EXPECT_EQ(readFile(out).substr(0, 16), "ply\nformat ascii");
  EXPECT_EQ(runPdc({"decimate", in, out, "--faces", "100", "--quiet"}).out, "");
}

TEST(DecimateCommand, WarnsWhereTheTargetIsOutOfReach) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "small.ply";
  writeMesh(sphere(4), in);
  const Outcome outcome = runPdc({"decimate", in, out, "--faces", "0"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.err.find("pdc: warning: 4 triangles are left"), std::string::npos) << outcome.err;
}

TEST(DecimateCommand, WeldsSoupAndWarnsOfIt) {
  const TemporaryFolder folder;
  const Mesh box = cube(4);
  Mesh soup;
  for (const Triangle& t : box.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) soup.positions.push_back(box.positions[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  const std::string in = folder / "soup.obj", out = folder / "small.ply";
  writeMesh(soup, in);
  const Outcome plain = runPdc({"decimate", in, out, "--faces", "12", "--json", "-"});
  EXPECT_NE(plain.err.find("pdc: warning: no two faces share a vertex"), std::string::npos) << plain.err;
  EXPECT_NE(plain.err.find("--weld"), std::string::npos) << plain.err;
  EXPECT_EQ(Json::parse(plain.out)["welded_vertices"], 0);
  const Outcome welded = runPdc({"decimate", in, out, "--faces", "12", "--weld", "0", "--json", "-"});
  EXPECT_EQ(welded.err, "");
  EXPECT_EQ(Json::parse(welded.out)["welded_vertices"], 576 - 98);
  EXPECT_EQ(Json::parse(welded.out)["faces"], 12);
  EXPECT_EQ(runPdc({"check", out}).exitCode, 0);
}

TEST(DecimateCommand, TakesNoiseFromAProperty) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "small.ply", json = folder / "report.json";
  Mesh ball = sphere(10);
  ball.properties = {{"sigma", 1, Buffer<float>(ball.positions.size(), 0.03F)}};
  writeMesh(ball, in);
  const Outcome outcome = runPdc({"decimate", in, out, "--faces", "100", "--sigma-property", "sigma", "--json", "-"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["sigma_property"], "sigma");
  EXPECT_NEAR(report["noise"].get<double>() * report["mean_edge"].get<double>(), 0.03, 1e-6);
  EXPECT_EQ(readMesh(out).positions, decimate(readMesh(in), {.faces = 100, .sigmaProperty = "sigma"}).positions);

  std::get<Buffer<float>>(ball.properties[0].values)[5] = -1;
  writeMesh(ball, in);
  const std::string before = readFile(out);
  const Outcome bad = runPdc({"decimate", in, out, "--faces", "100", "--sigma-property", "sigma", "--json", json});
  expectOneLineRefusal(bad, 1, {"ball.ply", "sigma", "vertex 5", "-1", ">= 0"});
  expectOneLineRefusal(runPdc({"decimate", in, out, "--faces", "9", "--sigma-property", "none"}), 1, {"'none'"});
  EXPECT_EQ(readFile(out), before);
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"ball.ply", "small.ply"}));
}

TEST(DecimateCommand, PolygonsAndPropertiesPass) {
  const TemporaryFolder folder;
  const std::string in = folder.write("pentagon.obj", "v 0 0 0\nv 2 0 0\nv 3 2 0\nv 1 3 0\nv -1 2 0\nf 1 2 3 4 5\n");
  EXPECT_EQ(runPdc({"decimate", in, folder / "out.ply", "--ratio", "1"}).exitCode, 0);
  EXPECT_EQ(readMesh(folder / "out.ply").triangles.size(), 3u);

  Mesh ball = sphere(8);
  ball.properties = {{"height", 1, Buffer<float>(ball.positions.size(), 2.5F)}};
  writeMesh(ball, folder / "ball.ply");
  EXPECT_EQ(runPdc({"decimate", folder / "ball.ply", folder / "out.ply", "--ratio", "0.3"}).exitCode, 0);
  const Mesh fewer = readMesh(folder / "out.ply");
  EXPECT_EQ(fewer.values<float>("height").size(), fewer.positions.size());
  for (const float height : fewer.values<float>("height")) EXPECT_EQ(height, 2.5F);
}

TEST(DecimateCommand, MergesWhatIsCloserThanThePairDistance) {
  const TemporaryFolder folder;
  const std::string in = folder / "cubes.ply", out = folder / "bar.ply";
  Mesh cubes = cube(4);  // Edges are 0.5 and 0.71 long, 0.57 on average.
  for (std::size_t v = 0, size = cubes.positions.size(); v < size; ++v)
    cubes.positions.push_back(cubes.positions[v] + Vec3f{2.1F, 0, 0});
  for (std::size_t t = 0, size = cubes.triangles.size(); t < size; ++t) {
    Triangle other = cubes.triangles[t];
    for (std::uint32_t& v : other) v += static_cast<std::uint32_t>(cubes.positions.size() / 2);
    cubes.triangles.push_back(other);
  }
  writeMesh(cubes, in);
  const Outcome outcome = runPdc({"decimate", in, out, "--faces", "12", "--pair-distance", "0.2L", "--json", "-"});
  EXPECT_EQ(outcome.exitCode, 0);
  const Json pairs = Json::parse(outcome.out)["pairs"];
  EXPECT_EQ(pairs["merges"], 4);
  EXPECT_EQ(pairs["components_before"], 2);
  EXPECT_EQ(pairs["components"], 1);
  EXPECT_EQ(pairs["non_manifold_edges"], 0);
  EXPECT_EQ(pairs["non_manifold_vertices"], 0);
  EXPECT_EQ(runPdc({"check", out}).exitCode, 0);

  const Outcome said = runPdc({"decimate", in, out, "--faces", "12", "--pair-distance", "0.11"});
  EXPECT_NE(said.out.find("4 merges without an edge; 1 components of 2; 0 non-manifold edges"), std::string::npos)
      << said.out;
  const Outcome apart = runPdc({"decimate", in, out, "--faces", "24", "--pair-distance", "0.09", "--json", "-"});
  EXPECT_EQ(Json::parse(apart.out)["pairs"]["components"], 2);
  EXPECT_EQ(Json::parse(runPdc({"decimate", in, out, "--faces", "24", "--json", "-"}).out)["pairs"], nullptr);
}

TEST(DecimateCommand, StaysWithinTheError) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "small.ply";
  writeMesh(sphere(20), in);
  const Outcome outcome = runPdc({"decimate", in, out, "--error", "0.1L", "--json", "-"});
  EXPECT_EQ(outcome.exitCode, 0);
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["end"], "error");
  EXPECT_DOUBLE_EQ(report["error"].get<double>(), 0.1 * report["mean_edge"].get<double>());
  EXPECT_LT(report["faces"].get<int>(), 1600);
  const Json compared = Json::parse(runPdc({"info", out, "--reference", in, "--json", "-"}).out);
  for (const char* way : {"to_reference", "from_reference"})
    EXPECT_LE(compared["reference"][way]["largest"].get<double>(), report["error"].get<double>() * (1 + 1e-5)) << way;
  const Outcome both = runPdc({"decimate", in, out, "--error", "0.1", "--faces", "4000"});
  EXPECT_NE(both.out.find(": 4000 of 4800 triangles"), std::string::npos) << both.out;
  EXPECT_NE(both.out.find("no point of either surface is farther than 0.1"), std::string::npos) << both.out;
}

TEST(DecimateCommand, RefusesInOneLine) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "small.ply";
  writeMesh(sphere(4), in);
  const std::string before = readFile(in);
  const auto refuses = [&](const Arguments& options, int exitCode, const std::vector<std::string>& mentions) {
    Arguments arguments{"decimate", in, out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expectOneLineRefusal(runPdc(arguments), exitCode, mentions);
  };
  refuses({}, 2, {"--faces", "--ratio", "required"});
  refuses({"--ratio", "0"}, 2, {"--ratio", "0", "above 0"});
  refuses({"--ratio", "1.5"}, 2, {"--ratio", "1.5", "at most 1"});
  refuses({"--faces", "-1"}, 2, {"--faces", "-1"});
  refuses({"--faces", "9", "--sigma-n", "-0.1"}, 2, {"--sigma-n", "-0.1", ">= 0"});
  refuses({"--faces", "9", "--weld", "-1"}, 2, {"--weld", "-1", ">= 0"});
  refuses({"--faces", "9", "--weld", "inf"}, 2, {"--weld", "inf", ">= 0"});
  refuses({"--faces", "9", "--memory", "2"}, 2, {"--memory", "2", "0 to 1"});
  refuses({"--faces", "9", "--quadric", "cubic"}, 2, {"--quadric", "cubic", "probabilistic-plane"});
  refuses({"--faces", "9", "--max-turn", "100"}, 2, {"--max-turn", "100", "90"});
  for (const std::string distance : {"0", "-1", "inf", "nan", "L", "0L", "2M", "1,2"})
    refuses({"--faces", "9", "--pair-distance=" + distance}, 2, {"--pair-distance", distance, "above 0"});
  for (const std::string error : {"0", "-1", "inf", "nan", "L", "0L", "2v", "1,2"})
    refuses({"--error=" + error}, 2, {"--error", error, "above 0"});
  refuses({"--error", "1", "--pair-distance", "2L"}, 2, {"--pair-distance", "--error"});
  refuses({"--faces", "9", "--pair-distance", "2L", "--sound"}, 2, {"--pair-distance", "--sound"});
  refuses({"--faces", "9", "--pair-distance", "2L", "--memory", "0.5"}, 2, {"--pair-distance", "--memory", "1"});
  refuses({"--faces", "9", "--json", in}, 2, {"--json", "INPUT"});
  expectOneLineRefusal(runPdc({"decimate", folder / "none.ply", out, "--faces", "9"}), 1, {"none.ply"});
  expectOneLineRefusal(runPdc({"decimate", in, folder / "out.txt", "--faces", "9"}), 1, {"out.txt"});
  expectOneLineRefusal(runPdc({"decimate", in, folder / "no/out.ply", "--faces", "9"}), 1, {"no"});
  EXPECT_EQ(readFile(in), before);
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"ball.ply"}) << "nothing is left behind";
}

}  // namespace
}  // namespace pdc::test
