#pragma once

#include <openvdb/openvdb.h>

#include "pdc/mesh/mesh.h"

namespace pdc::eval {

/// The faces of OpenVDB's own mesher, counter-clockwise seen from outside: quads and, where it merges cells, triangles.
/// \param adaptivity from 0 to 1: cells merge where one minus the cosine between their normals stays below.
[[nodiscard]] Mesh volumeToMesh(const openvdb::FloatGrid& grid, double iso, double adaptivity = 0);

}  // namespace pdc::eval
