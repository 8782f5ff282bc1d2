#pragma once

#include "io/file/byte_output.h"
#include "pdc/io/mesh/mesh_writer.h"

namespace pdc::detail {

/// A .3mf file (core specification 1.3) of triangles in world coordinates. Its unit is that of the options, or else the
/// millimetre. \throws Error where it would need more than 4 GiB.
void writeThreeMf(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options);

}  // namespace pdc::detail
