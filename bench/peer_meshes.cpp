// Writes the mesh that pdc makes by default and that of OpenVDB's mesher, side by side, to compare or draw.
// usage: peer_meshes FILE.vdb|KIND OUR.ply THEIR.ply (KIND as kinds_eval has it: its level set without noise)

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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: peer_meshes FILE.vdb|KIND OUR.ply THEIR.ply\n");
    return 2;
  }
  openvdb::initialize();
  try {
    const std::string input = argv[1];
    const auto grid = input.ends_with(".vdb") ? fromFile(input) : fromKind(input);
    const pdc::GridSource source(grid);
    pdc::writeMesh(pdc::contour(source), argv[2]);
    pdc::writeMesh(pdc::eval::volumeToMesh(*grid, source.iso()), argv[3]);
  } catch (const std::exception& e) {
    fmt::print(stderr, "peer_meshes: {}\n", e.what());
    return 1;
  }
}
