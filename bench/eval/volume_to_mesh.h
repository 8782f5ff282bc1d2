#pragma once

#include <openvdb/openvdb.h>

#include "pdc/mesh/mesh.h"

namespace pdc::eval {

/// The quads of OpenVDB's own mesher, with adaptivity 0, counter-clockwise seen from outside.
[[nodiscard]] Mesh volumeToMesh(const openvdb::FloatGrid& grid, double iso);

}  // namespace pdc::eval
