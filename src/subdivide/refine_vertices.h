#pragma once

#include <cstddef>
#include <cstdint>

#include "parallel/block_progress.h"
#include "pdc/math/gaussian_product.h"
#include "pdc/mesh/buffer.h"
#include "pdc/subdivide/subdivide.h"
#include "subdivide/half_edges.h"

namespace pdc::detail {

/// What each neighbour of a vertex inside the surface counts in Loop's scheme; the vertex counts the rest. At least 0
/// and at most 1 / neighbours. \param neighbours 2 or more.
[[nodiscard]] double loopWeight(std::size_t neighbours, LoopWeights weights);

/// The vertices of the next level, in the order that refineTriangles() and refinePolygons() give them. All weights are
/// >= 0 and sum to 1. Runs in parallel, and the result does not depend on the number of threads. \param progress
/// advances by the number of vertices made. \throws Cancelled.
template <typename Value>
[[nodiscard]] Buffer<Value> refineLoop(const HalfEdges& mesh, LoopWeights weights, const Buffer<Value>& vertices,
                                       BlockProgress& progress);
template <typename Value>
[[nodiscard]] Buffer<Value> refineCatmullClark(const HalfEdges& mesh, const Buffer<Value>& vertices,
                                               BlockProgress& progress);

}  // namespace pdc::detail
