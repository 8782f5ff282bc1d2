// How well the kinds of surfaces that people mesh come out, by default and with other choices, beside OpenVDB's mesher.
// Prints one line per case, over several poses.

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <mutex>

#include "eval/inputs.h"
#include "eval/kinds.h"
#include "eval/surface_figures.h"
#include "eval/volume_to_mesh.h"
#include "pdc/extract/contour.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc::eval {
namespace {

struct Request {
  bool heldOut = false;
  std::vector<std::string> kinds{}, inputs{"level_set", "fog"}, noise{"0", "0.02", "0.05", "0.1", "half"},
      methods{"default", "g05", "g25", "gauto", "d05", "vtm"};
  unsigned poses = 0;
};

struct Outcome {
  SurfaceFigures figures;
  double milliseconds = 0, outOfCell = 0;
  double noise = 0, normalNoise = 0, trueNormalNoise = 0;  ///< In values, in voxels, and in normals.
};

Outcome run(const PosedKind& posed, const GridInput& input, const std::string& method) {
  const auto begin = std::chrono::steady_clock::now();
  Outcome outcome;
  Mesh mesh;
  if (method == "vtm") {
    mesh = volumeToMesh(*input.grid, input.iso);
  } else {
    ContourOptions options{.threads = 1};
    GridSourceOptions grid{.iso = input.iso};
    if (method[0] == 'g') grid.hermite = HermiteMode::kGradient;
    if (method[0] == 'd' && method != "default") grid.hermite = HermiteMode::kDistance;
    if (method.ends_with("05")) options.sigmaNormal = 0.05;
    if (method.ends_with("25")) options.sigmaNormal = 0.25;
    if (method.ends_with("auto")) options.sigmaNormal = std::nullopt;
    if (method == "default") options.sigmaNormal = std::nullopt;
    const GridSource source(input.grid, grid);
    ContourReport report;
    mesh = contour(source, options, &report);
    outcome.outOfCell = 1e2 * static_cast<double>(report.outOfCell) /
                        static_cast<double>(std::max<std::size_t>(mesh.positions.size(), 1));
    outcome.noise = source.valueNoise();
    outcome.normalNoise = report.normalNoise;
    if (method == "default") outcome.trueNormalNoise = trueNormalNoise(source, posed);
  }
  outcome.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  outcome.figures = posed.measure(mesh);
  return outcome;
}

void print(const Kind& kind, const std::string& input, const std::string& noise, const std::string& method,
           const std::vector<Outcome>& outcomes) {
  std::vector<SurfaceFigures> figures;
  double milliseconds = 0, outOfCell = 0, found = 0, ofNormals = 0, truth = 0;
  for (const Outcome& o : outcomes) {
    figures.push_back(o.figures);
    milliseconds += o.milliseconds;
    outOfCell += o.outOfCell / static_cast<double>(outcomes.size());
    found += o.noise / static_cast<double>(outcomes.size());
    ofNormals += o.normalNoise / static_cast<double>(outcomes.size());
    truth += o.trueNormalNoise / static_cast<double>(outcomes.size());
  }
  const SurfaceFigures f = pool(figures);
  fmt::print(
      "{:<18} {:<9} {:<5} {:<8} {:8.4f} {:8.4f} {:7.2f} {:7.2f} {:7.1f} {:8.4f} {:8.4f} {:6} {:8} {:8.1f} {:6.2f} "
      "{:7.4f} {:6.3f} {:6.3f}\n",
      kind.shape.name, input, noise, method, f.vertexRms, f.surfaceRms, f.normalRms, f.normalP99, f.normalMax,
      f.edgeRms, f.cornerMax, f.turned, f.triangles, milliseconds, outOfCell, found, ofNormals, truth);
}

void runKind(const Kind& kind, const Request& request) {
  const unsigned first = request.heldOut ? 100000 : 0, poses = request.poses != 0 ? request.poses : kind.poses;
  std::vector<std::unique_ptr<PosedKind>> posed;
  for (unsigned i = 0; i < poses; ++i)
    posed.push_back(std::make_unique<PosedKind>(kind, randomPose(first + i, kind.size), i));
  struct Key {
    std::string input, noise, method;
  };
  std::vector<std::pair<Key, std::vector<Outcome>>> all;
  for (const std::string& input : request.inputs)
    for (const std::string& noise : request.noise)
      for (const std::string& method : request.methods)
        if (input == "level_set" || method != "d05") all.push_back({{input, noise, method}, {}});
  for (unsigned i = 0; i < poses; ++i)
    for (const std::string& input : request.inputs) {
      const GridInput clean = makeClean(
          input, [&](const Vec3d& p) { return posed[i]->distance(p); }, kind.reach);
      for (const std::string& noise : request.noise) {
        const bool half = noise == "half";
        const GridInput noisy = withNoise(clean, half ? 0 : std::stod(noise), half, first + 1000 * i + 7);
        for (auto& [key, outcomes] : all)
          if (key.input == input && key.noise == noise) outcomes.push_back(run(*posed[i], noisy, key.method));
      }
    }
  static std::mutex printing;
  const std::lock_guard lock(printing);
  for (const auto& [key, outcomes] : all) print(kind, key.input, key.noise, key.method, outcomes);
  std::fflush(stdout);
}

void run(const Request& request) {
  fmt::print(
      "{:<18} {:<9} {:<5} {:<8} {:>8} {:>8} {:>7} {:>7} {:>7} {:>8} {:>8} {:>6} {:>8} {:>8} {:>6} {:>7} {:>6} {:>6}\n",
      "kind", "input", "noise", "method", "vertex", "surface", "n rms", "n p99", "n max", "edge", "corner", "turned",
      "faces", "ms", "out %", "noise", "of n", "true");
  std::vector<Kind> kinds = makeKinds(request.heldOut);
  if (!request.kinds.empty())
    std::erase_if(kinds, [&](const Kind& k) {
      return std::find(request.kinds.begin(), request.kinds.end(), k.shape.name) == request.kinds.end();
    });
  tbb::parallel_for(std::size_t{0}, kinds.size(), [&](std::size_t i) { runKind(kinds[i], request); });
}

}  // namespace
}  // namespace pdc::eval

int main(int argc, char** argv) {
  pdc::eval::Request request;
  CLI::App app("Measures meshes of the kinds of surfaces that people mesh");
  app.add_flag("--held-out", request.heldOut, "Those that were kept apart");
  app.add_option("--kinds", request.kinds, "Only these")->delimiter(',');
  app.add_option("--inputs", request.inputs, "level_set, fog")->delimiter(',');
  app.add_option("--noise", request.noise, "Standard deviations, in voxels, or half")->delimiter(',');
  app.add_option("--methods", request.methods,
                 "default; g05, g25, gauto: gradients with σn; d05: planes from distances;\nvtm: VolumeToMesh")
      ->delimiter(',');
  app.add_option("--poses", request.poses, "Random poses of each; 0: as each kind asks for");
  CLI11_PARSE(app, argc, argv);
  openvdb::initialize();
  pdc::eval::run(request);
}
