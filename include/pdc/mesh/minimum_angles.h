#pragma once

#include "pdc/mesh/mesh.h"

namespace pdc {

/// The smallest angle of each triangle in degrees, 0 to 60, by the triangles' numbers: the two of each quad first, as
/// Mesh says. 0 for triangles of no area, NaN for those with a corner that is not finite. Runs in parallel.
/// \throws Error if a face names a vertex that does not exist.
[[nodiscard]] Buffer<float> minimumAngles(const Mesh& mesh);

}  // namespace pdc
