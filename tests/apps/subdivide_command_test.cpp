#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "apps/program.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/vertex_covariances.h"
#include "pdc/subdivide/subdivide.h"
#include "simplify/shapes.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

TEST(SubdivideCommand, WritesMoreTrianglesAndAReport) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "smooth.ply";
  writeMesh(sphere(4), in);
  const Outcome outcome = runPdc({"subdivide", in, out, "--levels", "3", "--json", "-", "--threads", "2"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.err, "");
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["scheme"], "loop");
  EXPECT_EQ(report["covariance"], "faces");
  EXPECT_EQ(report["faces_before"], 192);
  EXPECT_EQ(report["faces"], 192 * 64);
  EXPECT_EQ(report["boundary_edges"], 0);
  EXPECT_EQ(readMesh(out).positions, subdivide(readMesh(in), {.levels = 3}).positions);
  EXPECT_EQ(runPdc({"check", out}).exitCode, 0);
}

TEST(SubdivideCommand, OptionsReachTheLibrary) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "out.ply";
  writeMesh(sphere(2), in);
  const Mesh ball = readMesh(in);
  const auto expectLike = [&](Arguments arguments, const SubdivideOptions& options) {
    arguments.insert(arguments.begin(), {"subdivide", in, out, "--quiet"});
    const Outcome outcome = runPdc(arguments);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    const Mesh expected = subdivide(ball, options), written = readMesh(out);
    EXPECT_EQ(written.positions, expected.positions) << arguments.back();
    EXPECT_EQ(written.quads, expected.quads) << arguments.back();
  };
  expectLike({"--covariance", "none", "--weights", "warren"}, {.weights = LoopWeights::kWarren, .covariances = {}});
  expectLike({"--scheme", "catmull-clark", "--bias", "0.3"},
             {.scheme = SubdivisionScheme::kCatmullClark, .covariances = InferenceOptions{.bias = 0.3}});
  expectLike({"--absolute-bias", "0.01"}, {.covariances = InferenceOptions{.absoluteBias = 0.01}});
  expectLike({"--covariance", "vertices"}, {.covariances = InferenceOptions{.source = CovarianceSource::kVertices}});
  expectLike({"--covariance", "normals", "--sigma-n", "0.3"},
             {.covariances = InferenceOptions{.source = CovarianceSource::kNormals, .sigmaNormal = 0.3}});
  expectLike({"--crease-angle", "20"}, {.creaseAngle = 20});
}

TEST(SubdivideCommand, NormalsAndCurvatureAreOfTheLimit) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "out.ply";
  writeMesh(sphere(2), in);
  const Outcome outcome = runPdc({"subdivide", in, out, "--levels", "1", "--normals", "--curvature", "--json", "-"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["limit"], true);
  const Mesh expected = subdivide(readMesh(in), {.levels = 1, .limit = true, .normals = true, .curvature = true}),
             written = readMesh(out);
  EXPECT_EQ(written.positions, expected.positions);
  EXPECT_EQ(written.normals, expected.normals);
  EXPECT_EQ(written.properties, expected.properties);
  EXPECT_EQ(runPdc({"render", out, folder / "out.png", "--shading", "property:mean_curvature"}).exitCode, 0);
  EXPECT_EQ(runPdc({"subdivide", in, out, "--levels", "1", "--limit"}).exitCode, 0);
  EXPECT_EQ(readMesh(out).positions, expected.positions);
  EXPECT_EQ(readMesh(out).normals.size(), 0u);
  const Outcome dropped = runPdc({"subdivide", in, folder / "out.obj", "--curvature"});
  EXPECT_NE(dropped.err.find("pdc: warning: only .ply, .vtp and .glb files hold curvature"), std::string::npos) << dropped.err;
}

TEST(SubdivideCommand, TakesCovariancesFromTheFile) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "out.ply", more = folder / "more.ply";
  Mesh ball = sphere(2);
  std::vector<SymMat3<double>> covariances(ball.positions.size(), {1, 0, 0, 1, 0, 1});
  covariances[3] = {1e-3, 0, 0, 1, 0, 1};
  setVertexCovariances(ball, covariances);
  writeMesh(ball, in);
  EXPECT_EQ(runPdc({"subdivide", in, out, "--covariance", "file", "--keep-covariances"}).exitCode, 0);
  const SubdivideOptions options{.covariances = InferenceOptions{.source = CovarianceSource::kProperties},
                                 .keepCovariances = true};
  const Mesh expected = subdivide(ball, options), written = readMesh(out);
  EXPECT_EQ(written.positions, expected.positions);
  EXPECT_EQ(written.properties, expected.properties);
  const Json facts = Json::parse(runPdc({"info", out, "--json", "-"}).out);
  EXPECT_EQ(facts["covariances"]["positive_definite"], written.positions.size());
  EXPECT_EQ(runPdc({"subdivide", out, more, "--covariance", "file"}).exitCode, 0);

  covariances[5] = {1, 0, 0, -1, 0, 1};
  setVertexCovariances(ball, covariances);
  writeMesh(ball, in);
  const std::string before = readFile(out);
  expectOneLineRefusal(runPdc({"subdivide", in, out, "--covariance", "file"}), 1,
                       {"ball.ply", "covariance of vertex 5", "-1", "limit is 0"});
  EXPECT_EQ(readFile(out), before);
  const Json bad = Json::parse(runPdc({"info", in, "--json", "-"}).out);
  EXPECT_EQ(bad["covariances"]["positive_definite"], ball.positions.size() - 1);
  EXPECT_EQ(bad["covariances"]["first_other"], 5);
}

TEST(SubdivideCommand, PolygonsBecomeQuadsOrTrianglesWithAWarning) {
  const TemporaryFolder folder;
  const std::string in = folder.write("pentagon.obj", "v 0 0 0\nv 2 0 0\nv 3 2 0\nv 1 3 1\nv -1 2 0\nf 1 2 3 4 5\n");
  const std::string out = folder / "out.ply";
  EXPECT_EQ(runPdc({"subdivide", in, out, "--scheme", "catmull-clark", "--levels", "1"}).exitCode, 0);
  EXPECT_EQ(readMesh(out).quads.size(), 5u);
  const std::string box = folder.write("quad.obj", "v 0 0 0\nv 2 0 0\nv 2 2 1\nv 0 2 0\nf 1 2 3 4\n");
  const Outcome outcome = runPdc({"subdivide", box, out, "--levels", "1"});
  EXPECT_NE(outcome.err.find("pdc: warning: 1 faces with more than three corners became triangles"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(readMesh(out).triangles.size(), 8u);
}

TEST(SubdivideCommand, RefusesInOneLine) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.ply", out = folder / "out.ply";
  writeMesh(sphere(2), in);
  const auto refuses = [&](const Arguments& options, int exitCode, const std::vector<std::string>& mentions) {
    Arguments arguments{"subdivide", in, out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expectOneLineRefusal(runPdc(arguments), exitCode, mentions);
  };
  refuses({"--levels", "0"}, 2, {"--levels", "0"});
  refuses({"--scheme", "butterfly"}, 2, {"--scheme", "butterfly", "catmull-clark"});
  refuses({"--bias", "0"}, 2, {"--bias", "0", "above 0"});
  refuses({"--bias", "0.1", "--absolute-bias", "0.1"}, 2, {"--bias", "--absolute-bias"});
  refuses({"--covariance", "none", "--bias", "0.1"}, 2, {"--bias", "faces or vertices"});
  refuses({"--sigma-n", "0.1"}, 2, {"--sigma-n", "normals"});
  refuses({"--covariance", "none", "--keep-covariances"}, 2, {"--keep-covariances", "none"});
  refuses({"--crease-angle", "190"}, 2, {"--crease-angle", "190", "180"});
  refuses({"--json", in}, 2, {"--json", "INPUT"});
  refuses({"--levels", "20"}, 1, {"ball.ply", "20 levels make", "2^32 - 1"});
  refuses({"--covariance", "file"}, 1, {"ball.ply", "covxx"});
  const std::string sheets = folder.write("sheets.obj",
                                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\n"
                                          "f 1 2 3\nf 1 2 4\nf 2 1 5\n");
  expectOneLineRefusal(runPdc({"subdivide", sheets, out}), 1, {"sheets.obj", "edge of vertices 0 and 1", "3 faces"});
  const std::string points = folder.write("points.obj", "v 0 0 0\nv 1 0 0\n");
  expectOneLineRefusal(runPdc({"subdivide", points, out, "--quiet"}), 1, {"points.obj", "no faces"});
  expectOneLineRefusal(runPdc({"subdivide", in, folder / "out.txt"}), 1, {"out.txt"});
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"ball.ply", "points.obj", "sheets.obj"})) << "nothing is left";
}

}  // namespace
}  // namespace pdc::test
