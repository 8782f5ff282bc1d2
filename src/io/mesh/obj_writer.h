#pragma once

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

class AtomicFile;

/// v, vn (if the mesh has normals) and f lines; quads come before triangles, and those before polygons. \param world
/// writes world coordinates in double precision. \throws Error
void writeObj(const Mesh& mesh, AtomicFile& file, bool world);

}  // namespace pdc::detail
