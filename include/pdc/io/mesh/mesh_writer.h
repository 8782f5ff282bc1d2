#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "pdc/mesh/mesh.h"

namespace pdc {

struct MeshWriteOptions {
  bool ascii = false;  ///< .ply and .stl as text; .obj and .off always are text.
  /// .ply, .obj and .vtp hold world coordinates, the sums of the mesh's origin and its positions, in double precision,
  /// instead of the positions. Sums are rounded; those of a mesh made with ContourOptions::exactSums are exact.
  bool doublePrecision = false;
  /// What coordinates are in, such as "RAS" and "mm"; empty where that is not known. Blanks become '_'.
  std::string space{}, unit{};
  /// Where the mesh comes from and how it was made, in .glb, .3mf and .vtp; empty for nothing.
  std::string source{}, settings{};
};

/// Throws Error unless `path` can take a mesh: a suffix that is known and a folder that exists and can be written to.
/// Call it before long work. Makes no file.
void checkMeshPath(const std::filesystem::path& path);

/// Writes by suffix: .ply (binary little-endian unless ascii; float x y z, float nx ny nz if the mesh has normals, and
/// its properties in their order and types, vectors as NAME_x NAME_y NAME_z NAME_w; int or, above 2^31 vertices, uint
/// indices), .obj (shortest decimal that reads back to the same float; v, vn, f), .stl and .off through OpenMesh, .glb
/// (glTF 2.0, y up and in metres by its nodes), .3mf (in millimetres where no unit is said) and .vtp (for VTK and
/// ParaView). A .gz after the first four compresses them. Quads come before triangles, and those before polygons; in
/// .stl, .glb and .3mf all are triangles. Only .ply, .vtp and, in single precision, .glb hold properties; the others
/// leave them out, but for colours in .obj: where "red", "green" and "blue" are bytes they follow the
/// coordinates, as 0 to 1, which many programs read. An origin that is not zero is a comment "pdc_origin X Y Z" in
/// .ply, .obj and .off, and stands in the header or the first line of .stl; coordinates are relative to it. In .vtp and
/// .3mf they are sums with it, in .glb a node moves by it. Comments and headers say
/// space and unit, too, as "SPACE=RAS UNIT=mm"; from the 80 bytes of a .stl header they are left out where they do not fit.
///
/// The file appears under its name only when it is complete: it is written to a temporary file beside it, synchronised
/// and renamed. On any error the temporary file is removed and whatever stood under the name stays.
/// \returns bytes written. \throws Error if the file cannot be written or a face names a vertex that does not exist;
/// std::invalid_argument for a mesh whose arrays do not fit together, double precision in other files than .ply,
/// .obj and .vtp, and for a .ply whose properties' names are empty, hold blanks or control characters, or come twice, x, y, z,
/// nx, ny and nz included.
std::size_t writeMesh(const Mesh& mesh, const std::filesystem::path& path, const MeshWriteOptions& options = {});

}  // namespace pdc
