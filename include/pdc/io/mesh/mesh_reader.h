#pragma once

#include <filesystem>

#include "pdc/mesh/mesh.h"

namespace pdc {

struct MeshReadOptions {
  bool keepPolygons = false;  ///< Faces with more than four corners stay as they are instead of becoming triangles.
};

/// Reads .ply, .obj, .off and .stl as a soup: non-manifold, open and degenerate meshes arrive as they stand in the
/// file. Faces with three corners become triangles, with four quads, each kind in the order of the file. Larger ones
/// become polygons and then, unless they are to be kept, fans of triangles (see triangulatePolygons), which come after
/// all others. Vertices of .stl are welded by exact position. Vertex normals are kept where the file gives one to each
/// vertex.
///
/// All other properties that a .ply file gives to its vertices are kept with their names and types. Lists are not, and
/// of several with one name only the first is. Consecutive ones of one type named NAME_x, NAME_y and so on to NAME_w
/// are one property NAME with two to four components, unless another is called NAME.
///
/// \throws Error for a missing, empty or damaged file or an unknown suffix, and for a number in a .ply file as text
/// that the integer type of its property cannot hold.
[[nodiscard]] Mesh readMesh(const std::filesystem::path& path, const MeshReadOptions& options = {});

}  // namespace pdc
