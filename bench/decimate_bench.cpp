// Decimates meshes with this project's decimator and with others, on one thread, and prints how fast they are and how
// near to the input what they make is: a markdown table for each file and share of faces.

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "best_rates.h"
#include "decimation/decimation_peers.h"
#include "eval/triangle_input.h"
#include "pdc/mesh/mesh_comparison.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/simplify/decimate.h"

namespace {

using pdc::Mesh;
using pdc::Vec3d;
using pdc::eval::Decimated;
using pdc::eval::readTriangles;

struct Request {
  std::vector<std::filesystem::path> files{std::filesystem::path(PDC_SCENES) / "csg.yaml"};
  std::filesystem::path reference{};
  std::vector<double> shares{0.3, 0.05};
  std::size_t repeats = 3, samples = 1'000'000;
};

struct Method {
  std::string name;
  std::function<Decimated(const Mesh&, std::size_t)> decimate;
};

Decimated decimate(const Mesh& mesh, std::size_t targetFaces) {
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const double start = pdc::bench::threadSeconds();
  Decimated out{pdc::decimate(mesh, {.faces = targetFaces})};
  out.seconds = pdc::bench::threadSeconds() - start;
  return out;
}

std::vector<Method> methods() {
  std::vector<Method> all{{"pdc", decimate}};  // Rows of pdc::decimate go here.
  for (const auto& peer : pdc::eval::decimationPeers()) all.push_back({peer.name, peer.decimate});
  return all;
}

struct TriangleFigures {
  double meanSide = 0;
  double quality = 0;  ///< 4 √3 area / (sum of the squared sides): 1 for equilateral triangles; the mean.
};

TriangleFigures measureTriangles(const Mesh& mesh) {
  TriangleFigures figures;
  const auto count = static_cast<double>(mesh.triangles.size());
  for (const pdc::Triangle& t : mesh.triangles) {
    Vec3d side[3];
    double squares = 0;
    for (int k = 0; k < 3; ++k) {
      const pdc::Vec3f &from = mesh.positions[t[k]], &to = mesh.positions[t[(k + 1) % 3]];
      side[k] = pdc::vecCast<double>(to) - pdc::vecCast<double>(from);
      squares += dot(side[k], side[k]);
      figures.meanSide += length(side[k]) / (3 * count);
    }
    const double area = length(cross(side[0], side[1])) / 2;
    if (squares > 0) figures.quality += 4 * std::numbers::sqrt3 * area / squares / count;
  }
  return figures;
}

void printHead() {
  fmt::print(
      "| method | faces | k faces/s | to: mean | p99.9 | largest | from: mean | p99.9 | largest | angle | quality | "
      "flipped, % | intersections | non-manifold |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
}

/// \param unit of length. \param rate thousands of faces per second; 0 for none.
void printRow(const std::string& name, const Mesh& mesh, const Mesh& reference, const Request& request, double unit,
              double rate) {
  const pdc::MeshComparison c = pdc::compareMeshes(mesh, reference, {.samples = request.samples});
  const pdc::SelfIntersections found = pdc::selfIntersections(mesh);
  const auto distances = [unit](const pdc::DistanceFigures& d) {
    return fmt::format("{:.4f} | {:.3f} | {:.3f}", d.mean / unit, d.p999 / unit, d.largest / unit);
  };
  fmt::print("| {} | {} | {} | {} | {} | {:.2f} | {:.3f} | {:.4f} | {}{} | {} |\n", name, mesh.triangles.size(),
             rate > 0 ? fmt::format("{:.0f}", rate) : "", distances(c.toReference), distances(c.fromReference),
             c.meanAngle, measureTriangles(mesh).quality, 100 * c.opposedShare, found.complete ? "" : "> ",
             found.pairs.size(), pdc::analyze(mesh).nonManifoldEdges);
  std::fflush(stdout);
}

void printMethod(const Method& method, const Mesh& mesh, const Mesh& reference, const Request& request,
                 std::size_t targetFaces) {
  std::vector<double> seconds;
  Decimated out;
  try {
    for (std::size_t i = 0; i < request.repeats; ++i) {
      out = method.decimate(mesh, targetFaces);
      seconds.push_back(out.seconds);
    }
  } catch (const pdc::eval::CannotHold& e) {
    fmt::print("| {} | {} |\n", method.name, e.what());
    return;
  }
  const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  out.mesh.origin = mesh.origin;
  printRow(method.name, out.mesh, reference, request, measureTriangles(mesh).meanSide,
           1e-3 * static_cast<double>(mesh.triangles.size()) / *middle);
}

void printFile(const std::filesystem::path& file, const std::optional<Mesh>& reference, const Request& request) {
  const Mesh mesh = readTriangles(file);
  for (const double share : request.shares) {
    const auto target = static_cast<std::size_t>(std::lround(share * static_cast<double>(mesh.triangles.size())));
    fmt::print("\n{}: {} faces, to {} ({:g} %)\n\n", file.stem().string(), mesh.triangles.size(), target, 100 * share);
    printHead();
    if (reference) printRow("the input", mesh, *reference, request, measureTriangles(mesh).meanSide, 0);
    for (const Method& method : methods()) printMethod(method, mesh, reference ? *reference : mesh, request, target);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app("Compares decimators: rates of one thread, and distances in mean sides of the input's triangles");
  app.add_option("FILES", request.files, "Meshes, or what is contoured first: .vdb, .yaml")->check(CLI::ExistingFile);
  app.add_option("--faces-share", request.shares, "Faces to keep of the input's")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--repeats", request.repeats, "The median time counts")->check(CLI::Range(1, 1000));
  app.add_option("--samples", request.samples, "On each surface, for distances")->check(CLI::Range(1, 1'000'000'000));
  app.add_option("--reference", request.reference, "Compare with this mesh, not with the input")
      ->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& name : pdc::eval::missingDecimationPeers())
      fmt::print("{} was not there when this was built\n", name);
    std::optional<Mesh> reference;
    if (!request.reference.empty()) reference = readTriangles(request.reference);
    for (const auto& file : request.files) printFile(file, reference, request);
  } catch (const std::exception& e) {
    fmt::print(stderr, "decimate_bench: {}\n", e.what());
    return 1;
  }
}
