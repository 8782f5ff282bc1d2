// Decimates meshes to within an error and measures how far the result and the input are from each other, and how many
// faces other decimators need to be as near: a markdown table.

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "best_rates.h"
#include "decimation/decimation_peers.h"
#include "eval/triangle_input.h"
#include "pdc/mesh/mesh_comparison.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/simplify/decimate.h"

namespace {

using pdc::Mesh;

struct Request {
  std::vector<std::filesystem::path> files{std::filesystem::path(PDC_SCENES) / "csg.yaml"};
  std::vector<double> errors{0.05, 0.1, 0.25, 1};
  std::size_t samples = 1'000'000;
  int steps = 7;
  bool own = false;
};

/// The largest distance of either surface from the other.
double farthest(const Mesh& mesh, const Mesh& input, std::size_t samples) {
  const pdc::MeshComparison c = pdc::compareMeshes(mesh, input, {.samples = samples});
  return std::max(c.toReference.largest, c.fromReference.largest);
}

/// About the fewest faces with which a decimator stays within a distance, found by bisection of their logarithm.
std::size_t fewestFaces(const pdc::eval::DecimationPeer& peer, const Mesh& input, double error,
                        const Request& request) {
  constexpr std::size_t kSamples = 200'000;
  std::size_t enough = input.triangles.size(), tooFew = 4;
  for (int i = 0; i < request.steps && enough > tooFew + 1; ++i) {
    const auto middle = static_cast<std::size_t>(std::sqrt(static_cast<double>(enough) * static_cast<double>(tooFew)));
    const Mesh mesh = peer.decimate(input, middle).mesh;
    if (!mesh.triangles.empty() && farthest(mesh, input, kSamples) <= error)
      enough = std::min(enough, mesh.triangles.size());
    else
      tooFew = middle;
  }
  return enough;
}

void printRow(const std::string& name, const Mesh& input, double error, const Request& request) {
  pdc::DecimateReport report;
  const double start = pdc::bench::threadSeconds();
  Mesh mesh;
  {
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    mesh = pdc::decimate(input, {.error = pdc::MeshLength{error, true}}, &report);
  }
  const double seconds = pdc::bench::threadSeconds() - start;
  const double measured = farthest(mesh, input, request.samples) / report.error;
  fmt::print("| {} | {} | {:g} | {} | {:.4f} | {} | {:.1f} |", name, input.triangles.size(), error,
             mesh.triangles.size(), measured, pdc::selfIntersections(mesh).pairs.size(),
             1e-3 * static_cast<double>(input.triangles.size()) / seconds);
  std::fflush(stdout);
  if (!request.own)
    for (const auto& peer : pdc::eval::decimationPeers()) {
      try {
        fmt::print(" {} |", fewestFaces(peer, input, report.error, request));
      } catch (const pdc::eval::CannotHold&) {
        fmt::print(" |");
      }
      std::fflush(stdout);
    }
  fmt::print("\n");
}

void printHead(bool own) {
  std::string names, rules;
  if (!own)
    for (const auto& peer : pdc::eval::decimationPeers()) {
      names += " " + peer.name + " |";
      rules += "---|";
    }
  fmt::print("| input | faces | error | faces left | measured / error | intersections | k faces/s |{}\n", names);
  fmt::print("|---|---|---|---|---|---|---|{}\n", rules);
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app("Decimates to within an error, in mean sides of the input's triangles");
  app.add_option("FILES", request.files, "Meshes, or what is contoured first: .vdb, .yaml")->check(CLI::ExistingFile);
  app.add_option("--errors", request.errors, "In mean sides")->delimiter(',')->allow_extra_args(false);
  app.add_option("--samples", request.samples, "On each surface, for distances")->check(CLI::Range(1, 1'000'000'000));
  app.add_option("--steps", request.steps, "Of the search for the fewest faces of others")->check(CLI::Range(1, 30));
  app.add_flag("--own", request.own, "Without other decimators");
  CLI11_PARSE(app, argc, argv);
  try {
    printHead(request.own);
    for (const auto& file : request.files) {
      const Mesh input = pdc::eval::readTriangles(file);
      for (const double error : request.errors) printRow(file.stem().string(), input, error, request);
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "error_decimation: {}\n", e.what());
    return 1;
  }
}
