#pragma once

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// The mesh of triangles with these corners, three each. Equal corners are one vertex; 0 and -0 are equal. Vertices are
/// in the order of their first appearance. \throws Error for more corners than a mesh can have vertices.
[[nodiscard]] Mesh weld(const Buffer<Vec3f>& corners);

}  // namespace pdc::detail
