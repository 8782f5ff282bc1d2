#pragma once

#include "io/file/byte_output.h"
#include "pdc/io/mesh/mesh_writer.h"

namespace pdc::detail {

/// A .vtp file (VTK, XML with raw binary data) of polygons in world coordinates, with normals and all properties. In
/// double precision if that is asked for or the mesh has an origin. \throws Error
void writeVtp(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options);

}  // namespace pdc::detail
