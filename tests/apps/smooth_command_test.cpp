#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "apps/program.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/smooth/smooth.h"
#include "simplify/shapes.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

Mesh noisyBall() {
  Mesh ball = sphere(12);
  addNoise(ball, 0.02);
  return ball;
}

TEST(SmoothCommand, WritesWhatTheLibraryMakesAndAReport) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "smooth.ply";
  writeMesh(noisyBall(), in);
  const Outcome outcome = runPdc({"smooth", in, out, "--sigma", "0.2", "--iterations", "3", "--normalise-area",
                                  "--lock-boundary", "--json", "-", "--threads", "2"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.err, "");
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["vertices"], 866);
  EXPECT_EQ(report["triangles"], 1728);
  EXPECT_EQ(report["iterations"], 3);
  EXPECT_EQ(report["sigma"], 0.2);
  EXPECT_EQ(report["normalise_area"], true);
  EXPECT_EQ(report["warnings"], Json::array());
  EXPECT_GT(report["mean_move"].get<double>(), 0.05);
  const Mesh expected = smooth(readMesh(in), {.iterations = 3, .sigma = 0.2, .normaliseArea = true});
  EXPECT_EQ(readMesh(out).positions, expected.positions);
}

TEST(SmoothCommand, SaysWhatItDid) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "smooth.ply";
  writeMesh(noisyBall(), in);
  const Outcome outcome = runPdc({"smooth", in, out, "--sigma", "0.25", "--ascii"});
  EXPECT_NE(outcome.out.find(": 866 vertices, 1728 triangles;"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("sigma 0.25 mean edges"), std::string::npos) << outcome.out;
  EXPECT_EQ(readFile(out).substr(0, 16), "ply\nformat ascii");
  EXPECT_EQ(runPdc({"smooth", in, out, "--quiet"}).out, "");
  EXPECT_EQ(readMesh(out).positions, smooth(readMesh(in), {}).positions);
  const Outcome plain = runPdc({"smooth", in, out, "--sigma", "adaptive", "--plain", "--json", "-"});
  EXPECT_EQ(Json::parse(plain.out)["sigma"], "adaptive");
  EXPECT_EQ(readMesh(out).positions, smooth(readMesh(in), {.plain = true}).positions);
}

TEST(SmoothCommand, TakesNoiseFromAProperty) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "smooth.ply";
  Mesh ball = noisyBall();
  ball.properties = {{"sigma", 1, Buffer<float>(ball.positions.size(), 0.02F)}};
  writeMesh(ball, in);
  const Outcome outcome = runPdc({"smooth", in, out, "--sigma-property", "sigma", "--json", "-"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["sigma_property"], "sigma");
  EXPECT_NEAR(report["mean_sigma"].get<double>() * report["mean_edge"].get<double>(), 0.02, 1e-6);
  EXPECT_EQ(readMesh(out).properties, ball.properties);

  std::get<Buffer<float>>(ball.properties[0].values)[5] = -1;
  writeMesh(ball, in);
  const std::string before = readFile(out);
  expectOneLineRefusal(runPdc({"smooth", in, out, "--sigma-property", "sigma"}), 1,
                       {"ball.ply", "sigma", "vertex 5", "-1", ">= 0"});
  expectOneLineRefusal(runPdc({"smooth", in, out, "--sigma-property", "none"}), 1, {"ball.ply", "'none'"});
  EXPECT_EQ(readFile(out), before);
}

TEST(SmoothCommand, RefusesInOneLine) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "smooth.ply";
  Mesh ball = sphere(4);
  writeMesh(ball, in);
  const auto refuses = [&](const Arguments& options, const std::vector<std::string>& mentions) {
    Arguments arguments{"smooth", in, out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expectOneLineRefusal(runPdc(arguments), 2, mentions);
  };
  for (const std::string sigma : {"-0.1", "inf", "nan", "much"}) refuses({"--sigma=" + sigma}, {"--sigma", sigma});
  for (const std::string iterations : {"-1", "1001", "1.5"})
    refuses({"--iterations=" + iterations}, {"--iterations", iterations});
  refuses({"--json", in}, {"--json", "INPUT"});
  expectOneLineRefusal(runPdc({"smooth", folder / "none.ply", out}), 1, {"none.ply"});
  expectOneLineRefusal(runPdc({"smooth", in, folder / "out.txt"}), 1, {"out.txt"});
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"ball.ply"}) << "nothing is left behind";

  ball.positions.push_back({5, 5, 5});
  ball.triangles.push_back({ball.triangles[0][0], ball.triangles[0][1], 98});
  writeMesh(ball, in);
  expectOneLineRefusal(runPdc({"smooth", in, out}), 1, {"ball.ply", "no oriented manifold", "2 vertices"});
  writeMesh({}, in);
  expectOneLineRefusal(runPdc({"smooth", in, out}), 1, {"ball.ply", "0 faces"});
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"ball.ply"});
}

}  // namespace
}  // namespace pdc::test
