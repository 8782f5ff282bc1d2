#pragma once

#include "pdc/mesh/mesh.h"

namespace pdc {

/// Replaces the mesh's polygons by fans of triangles from their first corners, n - 2 for n corners, which come after
/// the triangles that are there, polygon by polygon. Right for flat convex polygons; the fan of another one may overlap
/// itself. Vertices, quads and triangles stay. Runs in parallel; the result does not depend on the number of threads.
/// \throws std::invalid_argument for arrays that do not fit together, see Mesh; indices are not looked at.
void triangulatePolygons(Mesh& mesh);

}  // namespace pdc
