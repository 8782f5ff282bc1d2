#pragma once

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

class AtomicFile;

/// v, vn (if the mesh has normals) and f lines; quads come before triangles, and those before polygons. \throws Error
void writeObj(const Mesh& mesh, AtomicFile& file);

}  // namespace pdc::detail
