#pragma once

#include "extract/topology/surface.h"
#include "extract/vertices/sigma_normal.h"
#include "pdc/math/quadric.h"
#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc::detail {

/// The quadrics of a mesh's vertices as ContourReport::quadrics promises them. Samples the source a second time, so
/// that contouring stays as quick as it is. Runs in parallel; the same for any number of threads. \param mesh as solved
/// and certified; vertices beyond the topology's are those that certifying added.
[[nodiscard]] Buffer<Quadric<float>> vertexQuadrics(const Surface& surface, const SigmaNormal& sigma, const Mesh& mesh,
                                                    const Monitor& monitor);

}  // namespace pdc::detail
