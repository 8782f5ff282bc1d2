#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pdc/mesh/mesh.h"

namespace pdc {

/// Reads .ply, .obj, .off and .stl as a soup: non-manifold, open and degenerate meshes arrive as they stand in the
/// file. Faces with three corners become triangles, with four quads, larger ones fans of triangles. Vertices of .stl
/// are welded by exact position. Vertex normals are kept where the file gives one to each vertex. \throws Error for a
/// missing, empty or damaged file or an unknown suffix.
[[nodiscard]] Mesh readMesh(const std::filesystem::path& path);

/// A number per vertex that a .ply file gives under this name, in the order of readMesh(); empty if it gives none (no
/// such property, a list, another format). \throws Error for a missing or damaged file or an unknown suffix.
[[nodiscard]] std::optional<Buffer<float>> readVertexProperty(const std::filesystem::path& path,
                                                              const std::string& name);

}  // namespace pdc
