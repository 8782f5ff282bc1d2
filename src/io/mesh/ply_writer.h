#pragma once

#include <cstddef>

#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

class ByteOutput;

/// "int" if it holds every index of a mesh with that many vertices, else "uint".
[[nodiscard]] const char* plyIndexType(std::size_t vertices);

/// Binary little-endian or text; quads come before triangles, and those before polygons. \throws Error;
/// std::invalid_argument for names that checkPlyNames refuses.
void writePly(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options);

}  // namespace pdc::detail
