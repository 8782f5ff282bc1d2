#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "apps/program.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/mesh/vertex_covariances.h"
#include "pdc/points/gaussian_mixture.h"
#include "points/point_shapes.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

std::string sphereText(std::size_t n) {
  std::string text;
  for (const Vec3d& p : noisySphere(n, 0.005).positions)
    text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  return text;
}

TEST(MixtureCommand, WritesGaussiansAndAReport) {
  const TemporaryFolder folder;
  const std::string in = folder.write("ball.xyz", sphereText(3000)), out = folder / "gaussians.ply";
  const Outcome outcome = runPdc({"mixture", in, out, "--sigma0", "0.1", "--json", "-", "--threads", "2"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.err, "");
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["points"], 3000);
  EXPECT_EQ(report["sigma0"], 0.1);
  const GaussianMixture mixture = mixtureOf(readMesh(out));
  EXPECT_EQ(report["gaussians"], mixture.size());
  EXPECT_EQ(report["levels"].back()["gaussians"], mixture.size());
}

TEST(ReconstructCommand, WritesASurfaceItsCovarianceMeshAndAReport) {
  const TemporaryFolder folder;
  const std::string in = folder.write("ball.xyz", sphereText(5000)), out = folder / "ball.ply",
                    covariances = folder / "control.ply";
  const Outcome outcome =
      runPdc({"reconstruct", in, out, "--close", "--subdivide", "2", "--mesh-covariances", covariances, "--json", "-"});
  EXPECT_EQ(outcome.exitCode, 0);
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["triangulation"]["boundary_loops"], 0);
  EXPECT_EQ(report["triangles"], 16 * report["control_triangles"].get<int>());
  EXPECT_EQ(readMesh(out).triangles.size(), report["triangles"]);
  EXPECT_TRUE(hasVertexCovariances(readMesh(covariances)));
  const Outcome checked = runPdc({"check", out, "--json", "-"});
  EXPECT_EQ(Json::parse(checked.out)["boundary_edges"], 0);
}

TEST(ReconstructCommand, RefusesInOneLineAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string out = folder / "out.ply";
  expectOneLineRefusal(runPdc({"reconstruct", folder.write("a.xyz", "1 2 3\n1 2 3\n"), out}), 1, {"a.xyz", "coincide"});
  expectOneLineRefusal(runPdc({"reconstruct", folder.write("b.xyz", "1 2 3\n1 2\n"), out}), 1, {"b.xyz", "line 2"});
  expectOneLineRefusal(runPdc({"reconstruct", folder.write("c.las", "x"), out}), 1, {"c.las", "suffix"});
  expectOneLineRefusal(runPdc({"reconstruct", folder / "a.xyz", out, "--sigma0", "0"}), 2, {"--sigma0"});
  expectOneLineRefusal(runPdc({"mixture", folder / "a.xyz", folder / "out.obj"}), 2, {"only .ply"});
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"a.xyz", "b.xyz", "c.las"}));
}

}  // namespace
}  // namespace pdc::test
