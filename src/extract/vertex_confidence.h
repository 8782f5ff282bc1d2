#pragma once

#include "extract/topology/surface.h"
#include "pdc/extract/contour.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Gives the mesh the properties "confidence", "sigma" and "rank" as far as `options` asks for them. Samples the source
/// a second time, so that solving stays as quick as it is. \param mesh as solved and certified; vertices beyond the
/// topology's are those that certifying added on lattice edges, and are rated like their neighbours.
void addVertexConfidence(const Surface& surface, const ContourOptions& options, Mesh& mesh, const Monitor& monitor);

}  // namespace pdc::detail
