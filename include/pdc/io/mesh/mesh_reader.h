#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "pdc/mesh/mesh.h"

namespace pdc {

struct MeshReadOptions {
  bool keepPolygons = false;  ///< Faces with more than four corners stay as they are instead of becoming triangles.
  /// Called with a line that names the file, for each thing in it that is odd or was not read. What it throws passes
  /// through, an Error with the file's name before it.
  std::function<void(const std::string&)> warn = {};
};

/// Reads .ply, .obj, .off and .stl, and the same with .gz behind it, as a soup: non-manifold, open and degenerate
/// meshes arrive as they stand in the file, and so does a file without faces. Where the content says for certain that
/// it has another one of these formats than its suffix, it is read as that, with a warning. Faces with three corners
/// become triangles, with four quads, each kind in the order of the file; a flat quad that its first corner does not
/// split properly, but its second does, begins with that one, unless a comment says that writeMesh() wrote it. Larger
/// ones become polygons and then, unless they are to be kept, triangles (see triangulatePolygons), which come after all
/// others. Strips in .ply become triangles in the order of the file. Vertices of .stl are welded by exact position.
/// Vertex normals are kept where the file gives one to each vertex.
///
/// Coordinates are read in double precision. Where single precision would change one by more than a millionth of the
/// box's largest side, which needs a mesh more than 16 sides away from the origin, they are made relative to
/// Mesh::origin, a round place near the box's middle; differences of numbers that single precision holds stay exact. A
/// comment "pdc_origin X Y Z" (in .stl: such words in the header or the first line) is added to it.
///
/// All other properties that a .ply file gives to its vertices are kept with their names and types. Lists are not, and
/// of several with one name only the first is. Consecutive ones of one type named NAME_x, NAME_y and so on to NAME_w
/// are one property NAME with two to four components, unless another is called NAME.
///
/// \throws Error for a missing, empty or damaged file or an unknown suffix, for a file that is no mesh of these formats
/// or has faces of a kind that is not read, and for a number in a .ply file as text that the integer type of its
/// property cannot hold.
[[nodiscard]] Mesh readMesh(const std::filesystem::path& path, const MeshReadOptions& options = {});

}  // namespace pdc
