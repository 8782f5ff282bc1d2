// Decimates sound closed meshes with and without `sound`, and with other decimators, and counts the pairs of triangles
// that then intersect: a markdown table by input, and one by method.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "decimation/decimation_peers.h"
#include "eval/inputs.h"
#include "eval/shapes.h"
#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/field/noise.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/io/open_input.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_source.h"
#include "pdc/simplify/decimate.h"

namespace {

using pdc::Mesh;

constexpr std::array kShares{0.3, 0.05, 0.01};
/// Cells along the longest side of what is made here.
constexpr std::array kResolutions{64, 128};

/// Larger ones, of noise, would take other decimators minutes each.
constexpr std::size_t kMostFaces = 300'000;

struct Request {
  std::vector<std::filesystem::path> files{};
  bool own = false, filesOnly = false;
};

struct Method {
  std::string name;
  std::function<Mesh(const Mesh&, std::size_t)> decimate;
};

std::vector<Method> methods(bool own) {
  std::vector<Method> all{
      {"pdc, sound",
       [](const Mesh& mesh, std::size_t faces) { return pdc::decimate(mesh, {.faces = faces, .sound = true}); }},
      {"pdc", [](const Mesh& mesh, std::size_t faces) { return pdc::decimate(mesh, {.faces = faces}); }}};
  if (own) return all;
  for (const auto& peer : pdc::eval::decimationPeers())
    all.push_back({peer.name, [peer](const Mesh& mesh, std::size_t faces) { return peer.decimate(mesh, faces).mesh; }});
  return all;
}

/// What is wrong with the results of a method, over the inputs so far.
struct Sums {
  std::size_t meshes = 0, intersecting = 0, pairs = 0, nonManifoldEdges = 0, degenerate = 0, missed = 0;
};

/// \returns the number of pairs that intersect.
std::size_t count(const Mesh& mesh, std::size_t target, Sums& sums) {
  const pdc::SelfIntersections found = pdc::selfIntersections(mesh);
  ++sums.meshes;
  sums.intersecting += !found.pairs.empty();
  sums.pairs += found.pairs.size();
  sums.nonManifoldEdges += pdc::analyze(mesh).nonManifoldEdges;
  sums.degenerate += found.degenerateTriangles;
  sums.missed += mesh.triangles.size() > target;
  return found.pairs.size();
}

class Table {
 public:
  explicit Table(bool own) : mMethods(methods(own)) {
    fmt::print("| input | faces |");
    for (const double share : kShares)
      for (const Method& method : mMethods) fmt::print(" {:g} %: {} |", 100 * share, method.name);
    fmt::print("\n|---|---|");
    for (std::size_t i = 0; i < kShares.size() * mMethods.size(); ++i) fmt::print("---|");
    fmt::print("\n");
  }

  /// An input that is not sound shows nothing, and is named only; so are those of too many faces.
  void addRow(const std::string& name, const Mesh& mesh) {
    const pdc::MeshReport report = pdc::analyze(mesh);
    const pdc::SelfIntersections before = pdc::selfIntersections(mesh);
    if (mesh.empty() || mesh.triangles.size() > kMostFaces ||
        report.boundaryEdges + report.nonManifoldEdges + report.nonManifoldVertices > 0 || !before.pairs.empty() ||
        before.degenerateTriangles > 0) {
      fmt::print("| {} | {}: too large, or not sound |\n", name, mesh.triangles.size());
      return;
    }
    ++mInputs;
    fmt::print("| {} | {} |", name, mesh.triangles.size());
    for (const double share : kShares)
      for (const Method& method : mMethods) {
        const auto target = static_cast<std::size_t>(share * static_cast<double>(mesh.triangles.size()));
        fmt::print(" {} |", count(method.decimate(mesh, target), target, mSums[{share, method.name}]));
        std::fflush(stdout);
      }
    fmt::print("\n");
  }

  void printSums() const {
    fmt::print(
        "\n{} inputs\n\n| to | method | meshes that intersect | pairs | non-manifold edges | degenerate triangles | "
        "more faces than asked for |\n|---|---|---|---|---|---|---|\n",
        mInputs);
    for (const double share : kShares)
      for (const Method& method : mMethods) {
        const Sums& s = mSums.at({share, method.name});
        fmt::print("| {:g} % | {} | {} | {} | {} | {} | {} |\n", 100 * share, method.name, s.intersecting, s.pairs,
                   s.nonManifoldEdges, s.degenerate, s.missed);
      }
  }

 private:
  std::vector<Method> mMethods;
  std::map<std::pair<double, std::string>, Sums> mSums;
  std::size_t mInputs = 0;
};

Mesh contourTriangles(const pdc::HermiteSource& source, std::optional<double> sigmaNormal) {
  return pdc::contour(source, {.sigmaNormal = sigmaNormal, .triangles = true});
}

void addFile(Table& table, const std::filesystem::path& file, const pdc::InputOptions& options = {}) {
  const pdc::Input input = pdc::openInput(file, options);
  const std::string resolution = options.resolution ? fmt::format(" {}", *options.resolution) : "";
  table.addRow(file.stem().string() + resolution, contourTriangles(*input.source, input.sigmaNormal));
}

/// Surfaces that lie near themselves in many places: thin sheets, and noise.
void addMade(Table& table, int resolution) {
  const auto add = [&](const std::string& name, const pdc::FieldPtr& field) {
    const pdc::FieldSource source(field, {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 2.0 / resolution});
    table.addRow(fmt::format("{} {}", name, resolution), contourTriangles(source, std::nullopt));
  };
  const pdc::FieldPtr ball = pdc::sphere({0, 0, 0}, 0.95);
  add("thin gyroid", pdc::intersect({pdc::gyroid(0.7, 3.0 / resolution), ball}));
  add("noise in a ball", pdc::intersect({pdc::simplexNoise({.octaves = 3, .frequency = 2.5}), ball}));
  for (const pdc::eval::Shape& shape : pdc::eval::makeShapes(0.4 * resolution)) {
    if (shape.name != "plate" && shape.name != "tube" && shape.name != "wedge30") continue;
    for (const double noise : {0.0, 0.2}) {
      const auto pose = pdc::eval::randomPose(7, 0.4 * resolution);
      const pdc::GridSource source(pdc::eval::makeGrid("exact", shape, pose, noise, 7).grid);
      table.addRow(fmt::format("{}{} {}", shape.name, noise > 0 ? " with noise" : "", resolution),
                   contourTriangles(source, std::nullopt));
    }
  }
}

void print(const Request& request) {
  for (const std::string& name : pdc::eval::missingDecimationPeers())
    fmt::print("{} was not there when this was built\n", name);
  Table table(request.own);
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(PDC_SCENES))
    if (entry.path().extension() == ".yaml") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  for (const int resolution : kResolutions) {
    if (request.filesOnly) break;
    for (const auto& scene : scenes) addFile(table, scene, {.resolution = resolution});
    addMade(table, resolution);
  }
  for (const auto& file : request.files) {
    try {
      addFile(table, file);
    } catch (const pdc::Error& e) {
      fmt::print("| {} | {} |\n", file.stem().string(), e.what());
    }
  }
  table.printSums();
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app("Counts what intersects in decimated meshes of scenes, of surfaces made here, and of files");
  app.add_option("FILES", request.files, "What is contoured besides: .vdb, .yaml")->check(CLI::ExistingFile);
  app.add_flag("--own", request.own, "Not with other decimators");
  app.add_flag("--files-only", request.filesOnly, "Of the files only");
  CLI11_PARSE(app, argc, argv);
  try {
    openvdb::initialize();
    print(request);
  } catch (const std::exception& e) {
    fmt::print(stderr, "sound_decimation: {}\n", e.what());
    return 1;
  }
}
