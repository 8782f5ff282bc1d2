// Writes the mesh that pdc makes by default and that of OpenVDB's mesher, side by side, to compare or draw.
// usage: peer_meshes FILE.vdb|KIND OUR.ply THEIR.ply [E] (KIND as kinds_eval has it: its level set without noise; E in
// voxels: ours adaptive within it, theirs at the adaptivity that gives about as many triangles, or its least)

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>

#include "eval/inputs.h"
#include "eval/kinds.h"
#include "eval/volume_to_mesh.h"
#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/sample/vdb/grid_source.h"

namespace {

openvdb::FloatGrid::Ptr fromFile(const std::filesystem::path& path) {
  const auto grid = pdc::readVdbGrid(path);
  const auto floats = openvdb::gridPtrCast<openvdb::FloatGrid>(grid);
  if (floats == nullptr) throw pdc::Error(fmt::format("{}: no grid of floats", path.string()));
  return floats;
}

openvdb::FloatGrid::Ptr fromKind(const std::string& name) {
  for (const bool heldOut : {false, true})
    for (const pdc::eval::Kind& kind : pdc::eval::makeKinds(heldOut)) {
      if (kind.shape.name != name) continue;
      const pdc::eval::Pose pose = pdc::eval::randomPose(1, kind.size);
      const auto distance = [&](const pdc::Vec3d& p) { return kind.shape.distance(pose.toShape(p)) * pose.size; };
      return pdc::eval::makeClean("level_set", distance, kind.reach).grid;
    }
  throw pdc::Error(fmt::format("{}: no such kind", name));
}

std::size_t trianglesOf(const pdc::Mesh& mesh) { return mesh.triangles.size() + 2 * mesh.quads.size(); }

/// The mesh of OpenVDB's with the least adaptivity of those that have no more triangles; that with the fewest if none.
pdc::Mesh coarsened(const openvdb::FloatGrid& grid, double iso, std::size_t triangles) {
  constexpr int kSteps = 20;
  double few = 1, many = 0;
  pdc::Mesh mesh = pdc::eval::volumeToMesh(grid, iso, few);
  for (int i = 0; i < kSteps && trianglesOf(mesh) < triangles; ++i) {
    const double middle = 0.5 * (few + many);
    pdc::Mesh finer = pdc::eval::volumeToMesh(grid, iso, middle);
    if (trianglesOf(finer) > triangles) {
      many = middle;
      continue;
    }
    few = middle;
    mesh = std::move(finer);
  }
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    fmt::print(stderr, "usage: peer_meshes FILE.vdb|KIND OUR.ply THEIR.ply [E]\n");
    return 2;
  }
  openvdb::initialize();
  try {
    const std::string input = argv[1];
    const auto grid = input.ends_with(".vdb") ? fromFile(input) : fromKind(input);
    const pdc::GridSource source(grid);
    pdc::ContourOptions options;
    if (argc == 5) options.adaptive = std::stod(argv[4]) * source.map().voxelSize();
    const pdc::Mesh ours = pdc::contour(source, options);
    const pdc::Mesh theirs =
        argc == 5 ? coarsened(*grid, source.iso(), trianglesOf(ours)) : pdc::eval::volumeToMesh(*grid, source.iso());
    pdc::writeMesh(ours, argv[2]);
    pdc::writeMesh(theirs, argv[3]);
    fmt::print("{}: {} triangles, OpenVDB {}\n", input, trianglesOf(ours), trianglesOf(theirs));
  } catch (const std::exception& e) {
    fmt::print(stderr, "peer_meshes: {}\n", e.what());
    return 1;
  }
}
