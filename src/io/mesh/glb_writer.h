#pragma once

#include "io/file/byte_output.h"
#include "pdc/io/mesh/mesh_writer.h"

namespace pdc::detail {

/// A .glb file (glTF 2.0) of triangles with normals, colours and, under their names after a "_", the other properties
/// of the vertices as numbers of single precision. Nodes turn z up into y up, move by the origin, and scale to metres
/// where the unit is known. \throws Error where it would need more than 4 GiB.
void writeGlb(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options);

}  // namespace pdc::detail
