// Prints a table in Markdown: self-intersections of meshes by placement, beside OpenVDB's own mesher.
// usage: soundness_table FILE... (.vdb and .yaml; --shapes: level sets of solids in random poses, 32³ to 256³)

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "eval/inputs.h"
#include "eval/shapes.h"
#include "eval/volume_to_mesh.h"
#include "pdc/extract/contour.h"
#include "pdc/field/noise.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/io/scene/scene_reader.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_source.h"

namespace {

constexpr std::optional<double> kSigmas[] = {std::nullopt, 0.0, 0.01,
                                             0.1,          1.0, std::numeric_limits<double>::infinity()};

std::size_t triangleCount(const pdc::Mesh& mesh) { return 2 * mesh.quads.size() + mesh.triangles.size(); }

/// Intersecting pairs per thousand triangles; one digit more than it takes to tell none from few.
std::string hits(const pdc::Mesh& mesh) {
  const std::size_t pairs = pdc::selfIntersections(mesh).pairs.size();
  return pairs == 0
             ? "0"
             : fmt::format("{:.3g}", 1e3 * static_cast<double>(pairs) / static_cast<double>(triangleCount(mesh)));
}

/// The number of edges and vertices at which the mesh is no closed, coherently oriented manifold.
std::size_t faults(const pdc::Mesh& mesh) {
  const pdc::MeshReport r = pdc::analyze(mesh);
  return r.boundaryEdges + r.nonManifoldEdges + r.nonManifoldVertices + r.misorientedEdges;
}

void printRow(const std::string& name, const pdc::HermiteSource& source, const std::string& peer) {
  for (const std::optional<double> sigma : kSigmas) {
    pdc::ContourReport report;
    const pdc::Mesh certified = pdc::contour(source, {.sigmaNormal = sigma}, &report);
    const pdc::Mesh free = pdc::contour(source, {.sigmaNormal = sigma, .placement = pdc::Placement::kFree});
    const std::size_t n = certified.positions.size();
    fmt::print("| {} | {} | {} | {} | {} | {} | {:.2f} % | {:.2f} % | {} | {} | {} |\n", name,
               sigma ? fmt::format("{}", *sigma) : "auto", n, faults(certified), hits(certified), report.uncertified,
               1e2 * static_cast<double>(report.shortened) / static_cast<double>(n),
               1e2 * static_cast<double>(report.drawnIn) / static_cast<double>(n), report.fans, hits(free), peer);
    std::fflush(stdout);
  }
}

void printFile(const std::filesystem::path& path) {
  if (path.extension() == ".vdb") {
    const auto grid = pdc::readVdbGrid(path);
    const pdc::GridSource source(grid);
    const auto asFloat = openvdb::gridPtrCast<openvdb::FloatGrid>(grid);
    printRow(path.stem().string(), source, asFloat ? hits(pdc::eval::volumeToMesh(*asFloat, source.iso())) : "");
  } else {
    const pdc::Scene scene = pdc::readScene(path);
    printRow(path.stem().string(),
             pdc::FieldSource(scene.field, {.box = scene.box, .voxelSize = scene.voxelSize, .iso = scene.iso}), "");
  }
}

/// A narrow band of a field divided by its gradient's length, which is a distance near the surface.
openvdb::FloatGrid::Ptr levelSet(const pdc::Field& field, int resolution) {
  constexpr float kHalfWidth = 3;
  const auto grid = openvdb::FloatGrid::create(kHalfWidth);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto accessor = grid->getAccessor();
  for (openvdb::Coord c(0); c[0] < resolution; ++c[0])
    for (c[1] = 0; c[1] < resolution; ++c[1])
      for (c[2] = 0; c[2] < resolution; ++c[2]) {
        const pdc::Vec3d p{double(c[0]), double(c[1]), double(c[2])};
        const double value = field.valueAt(p), slope = pdc::length(field.gradientAt(p));
        const auto distance = static_cast<float>(value / std::max(slope, 0.1));
        if (std::abs(distance) < kHalfWidth)
          accessor.setValue(c, distance);
        else if (distance < 0)
          accessor.setValueOff(c, -kHalfWidth);
      }
  return grid;
}

/// Sums over all grids and all σn.
void printShape(const std::string& name, int resolution, const std::vector<openvdb::FloatGrid::Ptr>& grids) {
  std::size_t meshes = 0, triangles = 0, broken = 0, pairs = 0, freePairs = 0, freeTriangles = 0, uncertified = 0;
  for (const auto& grid : grids) {
    const pdc::GridSource source(grid);
    for (const std::optional<double> sigma : kSigmas) {
      pdc::ContourReport report;
      const pdc::Mesh certified = pdc::contour(source, {.sigmaNormal = sigma}, &report);
      const pdc::Mesh free = pdc::contour(source, {.sigmaNormal = sigma, .placement = pdc::Placement::kFree});
      const pdc::SelfIntersections found = pdc::selfIntersections(certified);
      ++meshes;
      triangles += triangleCount(certified);
      broken += faults(certified);
      pairs += found.pairs.size() + found.degenerateTriangles;
      uncertified += report.uncertified;
      freePairs += pdc::selfIntersections(free).pairs.size();
      freeTriangles += triangleCount(free);
    }
  }
  fmt::print("| {} | {}³ | {} | {} | {} | {} | {} | {:.3g} |\n", name, resolution, meshes, triangles, broken, pairs,
             uncertified, 1e3 * static_cast<double>(freePairs) / static_cast<double>(freeTriangles));
  std::fflush(stdout);
}

void printShapes() {
  fmt::print(
      "| solid | voxels | meshes | triangles | open, non-manifold, misoriented | hits and degenerate "
      "| uncertified | hits, free |\n|---|---|---|---|---|---|---|---|\n");
  for (const int resolution : {32, 64, 128, 256}) {
    const double size = 0.25 * resolution;
    for (const pdc::eval::Shape& shape : pdc::eval::makeShapes(size)) {
      std::vector<openvdb::FloatGrid::Ptr> grids;
      for (unsigned pose = 0; pose < (resolution > 64 ? 1 : 4); ++pose)
        for (const double noise : {0.0, 0.05, 0.2})
          grids.push_back(
              pdc::eval::makeGrid("exact", shape, pdc::eval::randomPose(5000 + pose, size), noise, pose).grid);
      printShape(shape.name, resolution, grids);
    }
    const double n = resolution;
    const pdc::FieldPtr ball = pdc::sphere({n / 2, n / 2, n / 2}, 0.45 * n);
    printShape("gyroid in a ball", resolution, {levelSet(*pdc::intersect({pdc::gyroid(n / 4, 0), ball}), resolution)});
    printShape("noise in a ball", resolution,
               {levelSet(*pdc::intersect({pdc::simplexNoise({.frequency = 8 / n}), ball}), resolution)});
  }
}

}  // namespace

int main(int argc, char** argv) {
  openvdb::initialize();
  if (argc == 2 && argv[1] == std::string("--shapes")) {
    printShapes();
    return 0;
  }
  fmt::print(
      "| input | σn | vertices | open, non-manifold, misoriented | hits | uncertified | shortened | drawn in | fans "
      "| hits, free | hits, VolumeToMesh |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 1; i < argc; ++i) {
    try {
      printFile(argv[i]);
    } catch (const std::exception& e) {
      fmt::print(stderr, "{}: {}\n", argv[i], e.what());
    }
  }
}
