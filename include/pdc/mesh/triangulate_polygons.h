#pragma once

#include "pdc/mesh/mesh.h"

namespace pdc {

/// Replaces the mesh's polygons by triangles, n - 2 for n corners, which come after the triangles that are there,
/// polygon by polygon. They fan out from the first corner where that tiles the polygon, as it does all convex ones;
/// others are cut along diagonals inside them. A polygon that meets itself gets as many triangles, which may overlap.
/// Corners that repeat others make triangles without area. Vertices, quads and triangles stay. Runs in parallel; the
/// result does not depend on the number of threads. \throws std::invalid_argument and Error as Mesh says.
void triangulatePolygons(Mesh& mesh);

}  // namespace pdc
