#pragma once

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// A unit normal for each vertex: the mean of those of its triangles, weighted by area. Zero where that is, or where
/// there are none. \param mesh without polygons; its indices are in range.
[[nodiscard]] Buffer<Vec3f> vertexNormals(const Mesh& mesh);

}  // namespace pdc::detail
