#pragma once

#include <cstdint>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc {

/// Which vertices lie on flat parts: 1 where all triangles around a vertex have normals within `degrees` of their mean,
/// weighted by area; 0 elsewhere, at vertices without a face and those whose faces are not finite or have no area.
/// \throws Error if a face names a vertex that does not exist.
[[nodiscard]] std::vector<std::uint8_t> flatVertices(const Mesh& mesh, double degrees);

/// How rough the flat parts are, in world units: the root mean square, over the vertices i < chosen.size() with
/// chosen[i] != 0, of the distance from a vertex along its normal to the mean of its neighbours. It is 0 if there are
/// none. A curved surface is rough by a quarter of its curvature times the square of the edges' length. The result does
/// not depend on the number of threads. \throws Error as flatVertices() does.
[[nodiscard]] double roughness(const Mesh& mesh, const std::vector<std::uint8_t>& chosen);

}  // namespace pdc
