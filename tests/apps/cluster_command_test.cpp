#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/program.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/simplify/cluster.h"
#include "simplify/shapes.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

TEST(ClusterCommand, WritesFewerTrianglesAndAReport) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "small.ply";
  writeMesh(sphere(20), in);
  const Outcome outcome = runPdc({"cluster", in, out, "--cell", "0.3", "--json", "-", "--threads", "2"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.err, "");
  ClusterReport expected;
  const Mesh mesh = cluster(readMesh(in), {.cell = 0.3}, &expected);
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["triangles_before"], 4800);
  EXPECT_EQ(report["triangles"], expected.trianglesAfter);
  EXPECT_EQ(report["vertices"], expected.vertices);
  EXPECT_EQ(report["cells"], expected.cells);
  EXPECT_EQ(report["collapsed_triangles"], expected.collapsedTriangles);
  EXPECT_EQ(report["outside_vertices"], expected.outsideVertices);
  EXPECT_EQ(report["cell"], 0.3);
  EXPECT_EQ(report["quadric"], "probabilistic-plane");
  EXPECT_EQ(report["sigma_n"], 0.05);
  EXPECT_EQ(report["warnings"], Json::array());
  const Mesh written = readMesh(out);
  EXPECT_EQ(written.triangles, mesh.triangles);
  EXPECT_EQ(written.positions, mesh.positions);
}

TEST(ClusterCommand, PassesItsOptionsOn) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.stl", out = folder / "small.ply";
  writeMesh(sphere(20), in);
  const auto positions = [&](const Arguments& options) {
    Arguments arguments{"cluster", in, out, "--cell", "0.3", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = runPdc(arguments);
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
    return readMesh(out).positions;
  };
  const auto expected = [&](const ClusterOptions& options) { return cluster(readMesh(in), options).positions; };
  EXPECT_EQ(positions({"--quadric", "plane", "--free"}),
            expected({.cell = 0.3, .quadric = QuadricKind::kPlane, .free = true}));
  EXPECT_EQ(positions({"--sigma-n", "0.5"}), expected({.cell = 0.3, .sigmaNormal = 0.5}));
  EXPECT_EQ(positions({"--quadric", "probabilistic-triangle", "--sigma-p", "0.1"}),
            expected({.cell = 0.3, .quadric = QuadricKind::kProbabilisticTriangle, .sigmaPosition = 0.1}));
}

TEST(ClusterCommand, WeldsWhatItReads) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.stl", out = folder / "small.ply";
  writeMesh(sphere(20), in);
  const Outcome outcome = runPdc({"cluster", in, out, "--cell", "0.3", "--weld", "0.05", "--json", "-"});
  EXPECT_EQ(outcome.exitCode, 0);
  ClusterReport expected;
  const Mesh mesh = cluster(readMesh(in), {.cell = 0.3, .weld = 0.05}, &expected);
  EXPECT_GT(expected.weldedVertices, 0u);
  EXPECT_EQ(Json::parse(outcome.out)["welded_vertices"], expected.weldedVertices);
  EXPECT_EQ(readMesh(out).positions, mesh.positions);
  expectOneLineRefusal(runPdc({"cluster", in, out, "--cell", "1", "--weld", "-1"}), 2, {"--weld", "-1", ">= 0"});
}

TEST(ClusterCommand, SaysWhatItDid) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.obj", out = folder / "small.ply";
  Mesh ball = sphere(20);
  ball.triangles.push_back({0, 1, static_cast<std::uint32_t>(ball.positions.size())});
  ball.positions.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
  writeMesh(ball, folder / "ball.ply");
  const Outcome outcome = runPdc({"cluster", folder / "ball.ply", out, "--cell", "0.3", "--clean", "--ascii"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.out.find(" of 4801 triangles, "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(" folded and 0 duplicate triangles dropped"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.err.find("pdc: warning: 1 triangles are not finite and are left out"), std::string::npos);
  EXPECT_EQ(readFile(out).substr(0, 16), "ply\nformat ascii");
  writeMesh(plate(3), in);
  EXPECT_NE(runPdc({"cluster", in, out, "--cell", "9"}).err.find("no triangles are left"), std::string::npos);
}

TEST(ClusterCommand, RefusesInOneLine) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "small.ply";
  writeMesh(sphere(4), in);
  const std::string before = readFile(in);
  const auto refuses = [&](const Arguments& options, int exitCode, const std::vector<std::string>& mentions) {
    Arguments arguments{"cluster", in, out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expectOneLineRefusal(runPdc(arguments), exitCode, mentions);
  };
  refuses({}, 2, {"--cell", "required"});
  refuses({"--cell", "0"}, 2, {"--cell", "0", "> 0"});
  refuses({"--cell", "inf"}, 2, {"--cell", "inf", "> 0"});
  refuses({"--cell", "1", "--sigma-n", "-0.1"}, 2, {"--sigma-n", "-0.1", ">= 0"});
  refuses({"--cell", "1", "--sigma-p", "x"}, 2, {"--sigma-p", "x", ">= 0"});
  refuses({"--cell", "1", "--quadric", "cubic"}, 2, {"--quadric", "cubic", "probabilistic-plane"});
  refuses({"--cell", "1", "--json", in}, 2, {"--json", "INPUT"});
  refuses({"--cell", "1e-7"}, 1, {"ball.ply", "too far away", "1e-07"});
  expectOneLineRefusal(runPdc({"cluster", folder / "none.ply", out, "--cell", "1"}), 1, {"none.ply"});
  expectOneLineRefusal(runPdc({"cluster", in, folder / "out.txt", "--cell", "1"}), 1, {"out.txt"});
  expectOneLineRefusal(runPdc({"cluster", in, folder / "no/out.ply", "--cell", "1"}), 1, {"no"});
  EXPECT_EQ(readFile(in), before);
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"ball.ply"}) << "nothing is left behind";
}

}  // namespace
}  // namespace pdc::test
