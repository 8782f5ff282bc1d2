#pragma once

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Makes two triangles of each quad, before the triangles that are there. Runs in parallel.
void splitQuads(Mesh& mesh);

}  // namespace pdc::detail
