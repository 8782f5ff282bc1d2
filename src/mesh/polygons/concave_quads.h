#pragma once

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Makes the second corner of a quad its first where the diagonal from the first lies outside of the quad or leaves a
/// triangle without area, and the other diagonal splits it into two that face the same way, as it does flat quads.
/// Folded ones stay. Indices must have been checked.
void turnConcaveQuads(Mesh& mesh);

}  // namespace pdc::detail
