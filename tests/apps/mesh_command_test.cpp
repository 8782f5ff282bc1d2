#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/grid_files.h"
#include "apps/program.h"
#include "folders.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

std::string demoScene() { return sourceFolder() / "scenes/csg.yaml"; }

class MeshCommand : public ::testing::Test {
 protected:
  /// Contours into out.ply, expects success, and returns the report.
  Json contour(Arguments arguments) {
    arguments.insert(arguments.begin(), "mesh");
    arguments.insert(arguments.begin() + 2, {mOutput, "--json", mReport});
    mOutcome = runPdc(arguments);
    EXPECT_EQ(mOutcome.exitCode, 0) << mOutcome.err;
    return Json::parse(readFile(mReport));
  }

  TemporaryFolder mFolder;
  std::string mOutput = mFolder / "out.ply";
  std::string mReport = mFolder / "report.json";
  Outcome mOutcome;
};

TEST_F(MeshCommand, GridBecomesAClosedMesh) {
  const Json report = contour({bulletGrid()});
  const MeshReport mesh = analyze(readMesh(mOutput));
  EXPECT_EQ(mesh.eulerNumber, 2);
  EXPECT_EQ(mesh.boundaryEdges, 0U);
  EXPECT_EQ(mesh.nonManifoldEdges, 0U);
  EXPECT_GT(mesh.volume, 0);
  EXPECT_EQ(mesh.vertices, report["vertices"]);
  EXPECT_EQ(mesh.quads, report["quads"]);
  EXPECT_EQ(mOutcome.err, "");
  EXPECT_NE(mOutcome.out.find("closed"), std::string::npos) << mOutcome.out;
}

TEST_F(MeshCommand, SphereHasItsAreaAndVolume) {
  writeSphere(mFolder / "sphere.vdb");
  contour({mFolder / "sphere.vdb"});
  const MeshReport mesh = analyze(readMesh(mOutput));
  EXPECT_NEAR(mesh.volume, 4.0 / 3.0 * M_PI, 0.01 * 4.0 / 3.0 * M_PI);
  EXPECT_NEAR(mesh.area, 4.0 * M_PI, 0.01 * 4.0 * M_PI);
}

TEST_F(MeshCommand, SceneIsContouredAtTheResolutionAskedFor) {
  const Json coarse = contour({demoScene(), "--resolution", "20"});
  const Json fine = contour({demoScene(), "--resolution", "40"});
  const double ratio = fine["vertices"].get<double>() / coarse["vertices"].get<double>();
  EXPECT_GT(ratio, 3);
  EXPECT_LT(ratio, 5);
}

TEST_F(MeshCommand, ReportHasAllKeys) {
  const Json report = contour({bulletGrid(), "--sigma-n", "inf", "--threads", "2", "--triangles"});
  for (const char* key : {"input",
                          "output",
                          "vertices",
                          "quads",
                          "triangles",
                          "boundary_edges",
                          "clamped_vertices",
                          "out_of_cell_vertices",
                          "multi_vertex_cells",
                          "shortened_vertices",
                          "drawn_in_vertices",
                          "forced_diagonals",
                          "fans",
                          "uncertified_pairs",
                          "sigma_n",
                          "iso",
                          "placement",
                          "threads",
                          "peak_memory_bytes",
                          "bytes_written",
                          "warnings"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["input"], bulletGrid().string());
  EXPECT_EQ(report["output"], mOutput);
  EXPECT_EQ(report["sigma_n"], "inf");
  EXPECT_EQ(report["iso"], 0.0);
  EXPECT_EQ(report["threads"], 2);
  EXPECT_EQ(report["placement"], "certified");
  EXPECT_EQ(report["uncertified_pairs"], 0);
  EXPECT_EQ(report["quads"], 0);
  EXPECT_GT(report["triangles"], 0);
  EXPECT_EQ(report["bytes_written"], std::filesystem::file_size(mOutput));
  EXPECT_GT(report["peak_memory_bytes"], 1 << 20);
  EXPECT_TRUE(report["warnings"].empty());
  const Json& seconds = report["seconds"];
  const double parts =
      seconds["read"].get<double>() + seconds["contour"].get<double>() + seconds["write"].get<double>();
  EXPECT_GE(seconds["total"].get<double>(), 0.999 * parts);
}

TEST_F(MeshCommand, SigmaAndPlacementReachTheContouring) {
  contour({bulletGrid()});
  const std::string standard = readFile(mOutput);
  contour({bulletGrid(), "--sigma-n", "auto", "--placement", "certified"});
  EXPECT_TRUE(readFile(mOutput) == standard);
  for (const char* sigma : {"0.05", "0.5"}) {
    contour({bulletGrid(), "--sigma-n", sigma});
    EXPECT_FALSE(readFile(mOutput) == standard) << sigma;
  }
  EXPECT_EQ(contour({bulletGrid(), "--placement", "free"})["placement"], "free");
}

TEST_F(MeshCommand, SameBytesForAnyNumberOfThreads) {
  writeSphere(mFolder / "sphere.vdb");
  for (const std::string& input : {bulletGrid().string(), (mFolder / "sphere.vdb").string(), demoScene()}) {
    contour({input, "--threads", "1"});
    const std::string expected = readFile(mOutput);
    for (const char* threads : {"1", "2", "3", "8"})
      for (int run = 0; run < 5; ++run) {
        contour({input, "--threads", threads});
        EXPECT_TRUE(readFile(mOutput) == expected) << input << " with " << threads << " threads";
        EXPECT_EQ(mOutcome.err, "");
      }
  }
}

TEST_F(MeshCommand, IsoOutsideOfTheValuesWarnsAndGivesAnEmptyMesh) {
  const Json report = contour({bulletGrid(), "--iso", "7"});
  EXPECT_EQ(report["vertices"], 0);
  ASSERT_EQ(report["warnings"].size(), 1U);
  EXPECT_NE(mOutcome.err.find("warning: iso 7 is outside"), std::string::npos) << mOutcome.err;
  EXPECT_NE(mOutcome.err.find("the mesh is empty"), std::string::npos) << mOutcome.err;
  EXPECT_EQ(std::count(mOutcome.err.begin(), mOutcome.err.end(), '\n'), 1);
  EXPECT_TRUE(std::filesystem::exists(mOutput));
}

TEST_F(MeshCommand, HowAGridIsReadIsSaid) {
  const Json report = contour({bulletGrid()});
  EXPECT_EQ(report["grid"]["class"], "level set");
  EXPECT_EQ(report["grid"]["class_decided_by"], "file");
  EXPECT_EQ(report["grid"]["inside"], "low");
  EXPECT_EQ(report["grid"]["inside_decided_by"], "file");
  EXPECT_NEAR(report["grid"]["half_width_voxels"], 3, 0.2);
  EXPECT_NE(mOutcome.out.find("a level set (says the file), low values inside (says the file)"), std::string::npos);
  EXPECT_TRUE(contour({demoScene(), "--resolution", "20"})["grid"].is_null());
}

TEST_F(MeshCommand, ASceneThatIsCutOffByItsBoxIsSaid) {
  const std::string start = "voxel_size: 0.1\nbox: [[-1, -1, -1], [1, 1, ";
  const std::string shape = "]]\nshape: {sphere: {radius: 0.9}}\n";
  EXPECT_EQ(contour({mFolder.write("whole.yaml", start + "1" + shape)})["vertices_on_box"], 0);
  EXPECT_EQ(mOutcome.out.find("cut off"), std::string::npos);
  const std::string cut = mFolder.write("cut.yaml", start + "0.43" + shape);
  // A disc of radius 0.79 with a vertex per voxel.
  EXPECT_NEAR(contour({cut})["vertices_on_box"], M_PI * 0.79 * 0.79 / 0.01, 50);
  EXPECT_NE(mOutcome.out.find("the solid is cut off by the box"), std::string::npos) << mOutcome.out;
  EXPECT_EQ(contour({cut, "--open"})["vertices_on_box"], 0);
}

TEST_F(MeshCommand, AWeightOfZeroIsNoData) {
  writeSphere(mFolder / "seen.vdb", {.noiseGrids = true});
  // The weight "halved" is 0 where x is not positive.
  const Arguments arguments{mFolder / "seen.vdb", "--grid", "sphere", "--weight-grid", "halved"};
  const Json closed = contour(arguments);
  EXPECT_EQ(closed["boundary_edges"], 0);
  EXPECT_NEAR(closed["crossings_without_data"].get<double>() / closed["crossings"].get<double>(), 0.52, 0.04);
  EXPECT_NE(mOutcome.out.find("have weight 0 at an end"), std::string::npos) << mOutcome.out;
  Arguments open = arguments;
  open.emplace_back("--open");
  EXPECT_GT(contour(open)["boundary_edges"], 40);
  EXPECT_EQ(contour(open)["crossings_without_data"], 0);
  EXPECT_EQ(analyze(readMesh(mOutput)).eulerNumber, 1);
  EXPECT_GT(analyze(readMesh(mOutput)).bounds.lo.x, 0);
}

TEST_F(MeshCommand, ThousandsOfSpecksAreAWarning) {
  // One lattice point in 64 is inside.
  const std::string noise =
      "voxel_size: 0.02\nbox: [[-1, -1, -1], [1, 1, 1]]\nshape: {formula: {lipschitz: 140, "
      "expression: \"2.7 - cos(25*pi*x) - cos(25*pi*y) - cos(25*pi*z)\"}}\n";
  const Json report = contour({mFolder.write("noise.yaml", noise)});
  ASSERT_EQ(report["warnings"].size(), 1U);
  EXPECT_NE(mOutcome.err.find("are specks of at most 24 vertices; an --iso"), std::string::npos) << mOutcome.err;
}

TEST_F(MeshCommand, ClassAndSideReachTheGrid) {
  const Json report = contour({bulletGrid(), "--class", "level-set", "--inside", "high", "--iso", "0.001"});
  EXPECT_EQ(report["grid"]["class_decided_by"], "caller");
  EXPECT_EQ(report["grid"]["inside"], "high");
  EXPECT_LT(analyze(readMesh(mOutput)).volume, 0);
  EXPECT_EQ(contour({bulletGrid(), "--class", "fog", "--iso", "0"})["grid"]["class"], "fog volume");
}

TEST_F(MeshCommand, AWrongSideIsAWarningWithItsRemedy) {
  writeSphere(mFolder / "turned.vdb", {.positiveInside = true});
  const Json report = contour({mFolder / "turned.vdb"});
  ASSERT_EQ(report["warnings"].size(), 1U);
  EXPECT_NE(mOutcome.err.find("--inside high"), std::string::npos) << mOutcome.err;
  EXPECT_EQ(report["grid"]["inside_decided_by"], "values");
  EXPECT_NEAR(analyze(readMesh(mOutput)).volume, 4.0 / 3.0 * M_PI, 0.01 * 4.0 / 3.0 * M_PI);
}

TEST_F(MeshCommand, AFalseSheetIsAWarningAndCanBeFilled) {
  writeSphere(mFolder / "open.vdb", {.floodFilled = false});
  EXPECT_EQ(contour({mFolder / "open.vdb"})["warnings"].size(), 1U);
  EXPECT_NE(mOutcome.err.find("--flood-fill"), std::string::npos) << mOutcome.err;
  EXPECT_EQ(analyze(readMesh(mOutput)).components, 2U);
  EXPECT_TRUE(contour({mFolder / "open.vdb", "--flood-fill"})["warnings"].empty());
  EXPECT_EQ(analyze(readMesh(mOutput)).components, 1U);
}

TEST_F(MeshCommand, NonFiniteVoxelsCountAsOutsideOnRequest) {
  writeSphere(mFolder / "nan.vdb", {.nanVoxels = 3, .infiniteVoxels = 2});
  contour({mFolder / "nan.vdb", "--nan", "outside"});
  const MeshReport mesh = analyze(readMesh(mOutput));
  EXPECT_EQ(mesh.nonFiniteVertices, 0U);
  EXPECT_EQ(mesh.boundaryEdges, 0U);
  EXPECT_NEAR(mesh.volume, 4.0 / 3.0 * M_PI, 0.03 * 4.0 / 3.0 * M_PI);
}

TEST_F(MeshCommand, TakesTheNamedGrid) {
  writeSphere(mFolder / "two.vdb", {.twoGrids = true});
  EXPECT_GT(contour({mFolder / "two.vdb", "--grid", "other"})["vertices"], 0);
}

TEST_F(MeshCommand, WarnsWhereSinglePrecisionIsTooCoarse) {
  writeSphere(mFolder / "near.vdb", {.offset = 100});
  EXPECT_TRUE(contour({mFolder / "near.vdb"})["warnings"].empty());
  writeSphere(mFolder / "far.vdb", {.offset = 10000});
  EXPECT_EQ(contour({mFolder / "far.vdb"})["warnings"].size(), 1U);
  EXPECT_NE(mOutcome.err.find("single precision"), std::string::npos) << mOutcome.err;
}

TEST_F(MeshCommand, FewerFacesWhereTheSurfaceIsSimple) {
  const std::string scene = mFolder.write(
      "box.yaml", "resolution: 40\nbox: [[-1, -1, -1], [1, 1, 1]]\nshape:\n  box: {size: [1.21, 1.13, 1.07]}\n");
  const std::string out = mFolder / "box.ply";
  const Outcome outcome = runPdc({"mesh", scene, out, "--adaptive", "0.05v", "--json", "-"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["triangles"], 12);
  EXPECT_EQ(report["vertices"], 8);
  EXPECT_DOUBLE_EQ(report["adaptive"]["distance"].get<double>(), 0.05 * 2 / 40);
  EXPECT_GT(report["adaptive"]["triangles_before"].get<int>(), 5000);
  EXPECT_LE(report["adaptive"]["largest_vertex_distance"].get<double>(), 0.0025);
  EXPECT_EQ(runPdc({"check", out}).exitCode, 0);
  for (const std::string distance : {"0", "-1v", "inf", "v", "1L", "1,2"})
    expectOneLineRefusal(runPdc({"mesh", scene, out, "--adaptive=" + distance}), 2,
                         {"--adaptive", distance, "above 0"});
}

TEST_F(MeshCommand, AGridSaysHowFineTheFacesAre) {
  const std::string input = mFolder / "scaled.vdb";
  writeSphere(input, {.scaleGrids = true});
  const auto triangles = [&](const Json& report) {
    return 2 * report["quads"].get<double>() + report["triangles"].get<double>();
  };
  const Json whole = contour({input, "--grid", "sphere", "--adaptive", "0.3v"});
  EXPECT_TRUE(whole["adaptive"]["grid"].is_null());
  const Json fine = contour({input, "--grid", "sphere", "--adaptive", "0.03v"});
  const Json report = contour({input, "--grid", "sphere", "--adaptive", "0.3v", "--adaptive-grid", "scale"});
  EXPECT_EQ(report["adaptive"]["grid"], "scale");
  EXPECT_NEAR(report["adaptive"]["distance"].get<double>(), 0.03, 1e-7);
  EXPECT_NE(mOutcome.out.find("farther than 0.03 times 'scale' from the other"), std::string::npos) << mOutcome.out;
  EXPECT_GT(triangles(report), 2 * triangles(whole));
  EXPECT_LT(triangles(report), 0.8 * triangles(fine));
  // Half as many to each side would be those of one distance.
  const Mesh mesh = readMesh(mOutput);
  const auto left = std::count_if(mesh.positions.begin(), mesh.positions.end(), [](const Vec3f& p) { return p.x < 0; });
  EXPECT_GT(left, 3 * static_cast<std::ptrdiff_t>(mesh.positions.size()) / 4);
}

TEST_F(MeshCommand, QuietSaysNothing) {
  contour({bulletGrid(), "--quiet"});
  EXPECT_EQ(mOutcome.out, "");
  EXPECT_EQ(mOutcome.err, "");
}

TEST_F(MeshCommand, JsonOnStandardOutputStandsAlone) {
  const Outcome outcome = runPdc({"mesh", bulletGrid(), mOutput, "--json", "-"});
  EXPECT_EQ(Json::parse(outcome.out)["output"], mOutput);
}

TEST_F(MeshCommand, WritesEveryFormat) {
  contour({bulletGrid()});
  const MeshReport expected = analyze(readMesh(mOutput));
  for (const char* name : {"out.obj", "out.off", "out.stl", "ascii.ply"}) {
    SCOPED_TRACE(name);
    const std::string output = mFolder / name;
    const Arguments arguments = {"mesh", bulletGrid(), output, "--ascii"};
    ASSERT_EQ(runPdc(arguments).exitCode, 0);
    const MeshReport mesh = analyze(readMesh(output));
    EXPECT_EQ(mesh.vertices, expected.vertices);
    EXPECT_NEAR(mesh.volume, expected.volume, 1e-4 * expected.volume);
  }
}

TEST_F(MeshCommand, NormalsAreWritten) {
  contour({bulletGrid(), "--normals", "--ascii"});
  EXPECT_NE(readFile(mOutput).find("property float nx"), std::string::npos);
}

TEST_F(MeshCommand, NoiseGridsReachTheContouring) {
  const std::string input = mFolder / "sphere.vdb";
  writeSphere(input, {.noiseGrids = true});
  contour({input, "--grid", "sphere", "--sigma-n", "0.05"});
  const Buffer<Vec3f> plain = readMesh(mOutput).positions;
  const Json report =
      contour({input, "--grid", "sphere", "--sigma-n", "0.05", "--weight-grid", "weight", "--sigma-grid", "sigma"});
  EXPECT_EQ(report["sigma_grid"], "sigma");
  EXPECT_EQ(report["weight_grid"], "weight");
  const Buffer<Vec3f> noisy = readMesh(mOutput).positions;
  ASSERT_EQ(noisy.size(), plain.size());
  float left = 0, right = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    float& moved = plain[i].x > 0.2F ? right : left;
    if (std::abs(plain[i].x) > 0.2F) moved = std::max(moved, length(noisy[i] - plain[i]));
  }
  EXPECT_LT(left, 1e-5F);
  EXPECT_GT(right, 1e-4F);
}

TEST_F(MeshCommand, FaultyNoiseIsAWarning) {
  const std::string input = mFolder / "sphere.vdb";
  writeSphere(input, {.noiseGrids = true});
  const Outcome outcome = runPdc({"mesh", input, mOutput, "--grid", "sphere", "--sigma-grid", "faulty"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.err.find("negative or not finite"), std::string::npos) << outcome.err;
}

TEST_F(MeshCommand, SigmaFromTheDataIsReported) {
  const Json report = contour({bulletGrid()});
  EXPECT_EQ(report["sigma_n"], "auto");
  EXPECT_GT(report["normal_noise"], 0);
  EXPECT_GT(report["median_sigma_n"], 0.1);
  EXPECT_GT(report["crease_patches"], 100);
  const Outcome outcome = runPdc({"mesh", bulletGrid(), mOutput});
  EXPECT_NE(outcome.out.find("% of the vertices on creases"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("sigma_n from the data: median"), std::string::npos) << outcome.out;
}

TEST_F(MeshCommand, ConfidenceAndRankAreWrittenAndDrawn) {
  contour({bulletGrid()});
  const Mesh plain = readMesh(mOutput);
  contour({bulletGrid(), "--confidence", "--rank"});
  const Mesh rated = readMesh(mOutput);
  EXPECT_EQ(rated.positions, plain.positions);
  EXPECT_EQ(rated.quads, plain.quads);
  EXPECT_EQ(rated.values<float>("confidence").size(), plain.positions.size());
  EXPECT_EQ(rated.values<float>("sigma").size(), plain.positions.size());
  EXPECT_EQ(rated.values<std::uint8_t>("rank").size(), plain.positions.size());
  const Outcome drawn = runPdc({"render", mOutput, mFolder / "rated.png", "--shading", "confidence"});
  EXPECT_EQ(drawn.exitCode, 0) << drawn.err;
  EXPECT_NE(drawn.out.find("confidence from 0, blue, to 1, yellow"), std::string::npos) << drawn.out;
}

}  // namespace
}  // namespace pdc::test
