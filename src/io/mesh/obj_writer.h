#pragma once

#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

class ByteOutput;

/// v, vn (if the mesh has normals) and f lines; quads come before triangles, and those before polygons, all after
/// comments. \throws Error
void writeObj(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options);

}  // namespace pdc::detail
