#pragma once

#include <cstddef>
#include <filesystem>

#include "pdc/mesh/mesh.h"

namespace pdc {

struct MeshWriteOptions {
  bool ascii = false;  ///< .ply and .stl as text; .obj and .off always are text.
};

/// Throws Error unless `path` can take a mesh: a suffix that is known and a folder that exists and can be written to.
/// Call it before long work. Makes no file.
void checkMeshPath(const std::filesystem::path& path);

/// Writes by suffix: .ply (binary little-endian unless ascii; float x y z, and what the mesh has of float nx ny nz,
/// float confidence and uchar rank; int or, above 2^31 vertices, uint indices), .obj (shortest decimal that reads back
/// to the same float; v, vn, f), and .stl and .off through OpenMesh (.stl as triangles).
///
/// The file appears under its name only when it is complete: it is written to a temporary file beside it, synchronised
/// and renamed. On any error the temporary file is removed, whatever stood under the name stays, and Error is thrown.
/// \returns bytes written.
std::size_t writeMesh(const Mesh& mesh, const std::filesystem::path& path, const MeshWriteOptions& options = {});

}  // namespace pdc
