// Contours grids adaptively and measures how far the result is from the mesh without adaptivity, and how many triangles
// OpenVDB's adaptive mesher and CGAL's decimators need to stay as near: a markdown table.

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "best_rates.h"
#include "decimation/decimation_peers.h"
#include "eval/inputs.h"
#include "eval/kinds.h"
#include "eval/shapes.h"
#include "eval/volume_to_mesh.h"
#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/mesh/mesh_comparison.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/sample/vdb/grid_source.h"

namespace {

using pdc::Mesh;

/// Half the size of the solids, in voxels: their full meshes have some 10,000 to 30,000 triangles.
constexpr double kHalfSize = 24;

struct Request {
  std::vector<std::filesystem::path> files;
  std::vector<double> errors{0.02, 0.05, 0.1, 0.25};
  std::vector<std::string> solids{"box",    "box_minus_cylinder", "cross",    "torus",
                                  "sphere", "gyroid_12",          "noise_10", "noise_30"};
  std::size_t samples = 1'000'000;
  std::size_t searchSamples = 20'000;  // Where many meshes are compared.
  bool own = false;
};

std::size_t trianglesOf(const Mesh& mesh) { return mesh.triangles.size() + 2 * mesh.quads.size(); }

/// Splits the quads of a mesh into the triangles that they stand for.
Mesh split(const Mesh& mesh) {
  Mesh all;
  all.positions = mesh.positions;
  all.origin = mesh.origin;
  all.triangles = mesh.triangles;
  for (const pdc::Quad& q : mesh.quads) {
    all.triangles.push_back({q[0], q[1], q[2]});
    all.triangles.push_back({q[0], q[2], q[3]});
  }
  return all;
}

/// The largest distance of either surface from the other.
double farthest(const Mesh& mesh, const Mesh& other, std::size_t samples) {
  const pdc::MeshComparison c = pdc::compareMeshes(mesh, other, {.samples = samples});
  return std::max(c.toReference.largest, c.fromReference.largest);
}

openvdb::FloatGrid::Ptr solid(const std::string& name) {
  for (const pdc::eval::Shape& shape : pdc::eval::makeShapes(kHalfSize))
    if (shape.name == name) return pdc::eval::makeGrid("exact", shape, pdc::eval::randomPose(1, kHalfSize), 0, 1).grid;
  for (const pdc::eval::Kind& kind : pdc::eval::makeKinds(false)) {
    if (kind.shape.name != name) continue;
    const pdc::eval::Pose pose = pdc::eval::randomPose(1, kind.size);
    const auto distance = [&](const pdc::Vec3d& p) { return kind.shape.distance(pose.toShape(p)) * pose.size; };
    return pdc::eval::makeClean("level_set", distance, kind.reach).grid;
  }
  throw pdc::Error(fmt::format("{}: no such solid", name));
}

/// A mesh of OpenVDB's, with the triangles its quads stand for.
struct Coarsened {
  std::size_t triangles;
  double distance;  ///< From its mesh with adaptivity 0.
};

/// OpenVDB's meshes for adaptivities from 1 downwards, each half of the one before.
std::vector<Coarsened> openVdbMeshes(const openvdb::FloatGrid& grid, double iso, std::size_t samples) {
  constexpr double kStep = 2, kLeast = 1e-6;  // Below 1e-6 it merges nothing.
  const Mesh full = pdc::eval::volumeToMesh(grid, iso);
  std::vector<Coarsened> all{{trianglesOf(full), 0}};
  for (double adaptivity = 1; adaptivity > kLeast; adaptivity /= kStep) {
    const Mesh mesh = pdc::eval::volumeToMesh(grid, iso, adaptivity);
    const std::size_t triangles = trianglesOf(mesh);
    if (triangles == 0 || triangles == all.front().triangles) continue;
    all.push_back({triangles, farthest(mesh, full, samples)});
  }
  return all;
}

/// The fewest triangles of those within a distance.
std::size_t fewest(const std::vector<Coarsened>& meshes, double distance) {
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const Coarsened& m : meshes)
    if (m.distance <= distance) least = std::min(least, m.triangles);
  return least;
}

/// About the fewest triangles with which a decimator stays within a distance: to 5 %, near a first guess.
std::size_t fewestOf(const pdc::eval::DecimationPeer& peer, const Mesh& full, double distance, std::size_t guess,
                     std::size_t samples) {
  std::size_t best = full.triangles.size();
  const auto isNear = [&](std::size_t faces) {
    const Mesh mesh = peer.decimate(full, faces).mesh;
    if (mesh.triangles.empty() || farthest(mesh, full, samples) > distance) return false;
    best = std::min(best, mesh.triangles.size());
    return true;
  };
  constexpr std::size_t kFewest = 4;
  std::size_t enough = std::min(guess, full.triangles.size()), tooFew = 0;
  while (enough < full.triangles.size() && !isNear(enough)) {
    tooFew = enough;
    enough = std::min(2 * enough, full.triangles.size());
  }
  if (tooFew == 0)
    for (tooFew = enough / 2; tooFew >= kFewest && isNear(tooFew); tooFew /= 2) enough = tooFew;
  constexpr double kExact = 1.05;
  while (enough > tooFew + 1 && static_cast<double>(enough) > kExact * static_cast<double>(tooFew)) {
    const auto middle = static_cast<std::size_t>(std::sqrt(static_cast<double>(enough) * static_cast<double>(tooFew)));
    if (middle == tooFew || middle == enough) break;
    (isNear(middle) ? enough : tooFew) = middle;
  }
  return best;
}

struct Timed {
  Mesh mesh;
  double seconds;
};

Timed timedContour(const pdc::GridSource& source, pdc::ContourOptions options) {
  options.threads = 1;
  const double start = pdc::bench::threadSeconds();
  Mesh mesh = pdc::contour(source, options);
  return {std::move(mesh), pdc::bench::threadSeconds() - start};
}

bool isCompared(const pdc::eval::DecimationPeer& peer) {
  return peer.name == "CGAL planes" || peer.name == "CGAL Lindstrom-Turk";
}

/// What has to be there to compare with, the same for all errors.
struct Reference {
  std::string name;
  Timed full;
  Mesh triangles;
  pdc::MeshReport facts;
  std::vector<Coarsened> openVdb;
};

void printRow(const Reference& reference, const pdc::GridSource& source, double error, const Request& request) {
  const double distance = error * source.map().voxelSize();
  const Timed made = timedContour(source, {.adaptive = distance});
  const pdc::MeshReport facts = pdc::analyze(made.mesh);
  fmt::print("| {} | {:g} | {} | {} | {:.2f} | {:.2f} | {:.4f} | {} | {} | {} | {} |", reference.name, error,
             trianglesOf(reference.full.mesh), trianglesOf(made.mesh), reference.full.seconds, made.seconds,
             farthest(made.mesh, reference.full.mesh, request.samples) / distance, facts.boundaryEdges,
             facts.nonManifoldEdges + facts.nonManifoldVertices, pdc::selfIntersections(made.mesh).pairs.size(),
             facts.eulerNumber == reference.facts.eulerNumber
                 ? "kept"
                 : fmt::format("{} → {}", reference.facts.eulerNumber, facts.eulerNumber));
  std::fflush(stdout);
  if (!request.own) {
    fmt::print(" {} |", fewest(reference.openVdb, distance));
    std::fflush(stdout);
    for (const auto& peer : pdc::eval::decimationPeers()) {
      if (!isCompared(peer)) continue;
      try {
        fmt::print(" {} |",
                   fewestOf(peer, reference.triangles, distance, trianglesOf(made.mesh), request.searchSamples));
      } catch (const pdc::eval::CannotHold&) {
        fmt::print(" – |");
      }
      std::fflush(stdout);
    }
  }
  fmt::print("\n");
}

void printRows(const std::string& name, const openvdb::FloatGrid::Ptr& grid, const Request& request) {
  const pdc::GridSource source(grid);
  Reference reference{name, timedContour(source, {}), {}, {}, {}};
  reference.triangles = split(reference.full.mesh);
  reference.facts = pdc::analyze(reference.full.mesh);
  if (!request.own) reference.openVdb = openVdbMeshes(*grid, source.iso(), request.searchSamples);
  for (const double error : request.errors) printRow(reference, source, error, request);
}

openvdb::FloatGrid::Ptr fromFile(const std::filesystem::path& file) {
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(pdc::readVdbGrid(file));
  if (grid == nullptr) throw pdc::Error(fmt::format("{}: no grid of floats", file.string()));
  return grid;
}

void printHead(bool own) {
  std::string names, rules;
  if (!own) {
    names = " `volumeToMesh` |";
    rules = "---|";
    for (const auto& peer : pdc::eval::decimationPeers()) {
      if (!isCompared(peer)) continue;
      names += " " + peer.name + " |";
      rules += "---|";
    }
  }
  fmt::print(
      "| input | E | full | adaptive | s, full | s, adaptive | measured / E | boundary | non-manifold | intersections "
      "| "
      "Euler number |{}\n|---|---|---|---|---|---|---|---|---|---|---|{}\n",
      names, rules);
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app("Contours grids adaptively and compares with others' meshes that are as near");
  app.add_option("FILES", request.files, ".vdb files, besides the solids")->check(CLI::ExistingFile);
  app.add_option("--errors", request.errors, "In voxels")->delimiter(',')->allow_extra_args(false);
  app.add_option("--solids", request.solids, "As feature_eval and kinds_eval name them; - for none")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--samples", request.samples, "On each surface, for distances")->check(CLI::Range(1, 1'000'000'000));
  app.add_option("--search-samples", request.searchSamples,
                 "The same where the fewest triangles of others are searched")
      ->check(CLI::Range(1, 1'000'000'000));
  app.add_flag("--own", request.own, "Without the others");
  CLI11_PARSE(app, argc, argv);
  openvdb::initialize();
  try {
    printHead(request.own);
    for (const auto& name : request.solids)
      if (name != "-") printRows(name, solid(name), request);
    for (const auto& file : request.files) printRows(file.stem().string(), fromFile(file), request);
  } catch (const std::exception& e) {
    fmt::print(stderr, "adaptive_eval: {}\n", e.what());
    return 1;
  }
}
