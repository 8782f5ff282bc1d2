#pragma once

#include "pdc/field/field.h"
#include "pdc/mesh/mesh.h"

namespace pdc {

/// The signed distance from a mesh in world units: negative inside, where the size of the generalised winding number is
/// above 1/2 (see MeshSource), on either side that of the nearest triangle. The solid holds its boundary. The gradient
/// is the unit vector away from the nearest point; on the mesh itself, a nearest triangle's normal.
///
/// For a closed mesh that does not intersect itself this is the exact distance but for rounding, and the Lipschitz
/// constant is 1. Of a closed mesh that intersects itself triangles inside the solid count for the distance, too, so
/// that its size may be too small there, but the zero set is right. Of an open mesh the function is 0 at the winding
/// number's level 1/2, too, where it closes holes: values near to it are that level's distance to first order, and no
/// Lipschitz constant is known. Bounds are those of the distance.
///
/// Quads and polygons count as the triangles that they stand for; triangles with a coordinate that is not finite do not
/// count. Keeps what it needs of the mesh. \throws std::invalid_argument and Error as Mesh says; Error for a mesh
/// without a triangle that counts.
FieldPtr meshField(const Mesh& mesh);

}  // namespace pdc
