#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/mesh.h"

namespace pdc {

/// What meshes are written as, for help texts.
inline constexpr const char* kWrittenMeshes = ".ply, .obj, .off, .stl (also with .gz), .glb, .3mf or .vtp";

/// A mesh from a file, and what the reader warned of.
struct MeshFile {
  Mesh mesh;
  std::vector<std::string> warnings;
};

/// Reads a mesh and puts the warnings on standard error, unless `quiet`. \param keepPolygons see MeshReadOptions.
/// \throws Error.
[[nodiscard]] MeshFile readMeshFile(const std::filesystem::path& path, bool quiet = false, bool keepPolygons = false);

/// Writes a mesh, with a sign that it is at work unless `quiet`. \returns bytes written. \throws Error.
std::size_t writeMeshFile(const Mesh& mesh, const std::filesystem::path& path, const MeshWriteOptions& options,
                          bool quiet);

}  // namespace pdc
