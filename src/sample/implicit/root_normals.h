#pragma once

#include "pdc/sample/hermite_block.h"
#include "sample/implicit/edge_roots.h"

namespace pdc::detail {

/// Unit normals at the crossings, a hair beside them where those are lattice points: the gradient, normalised; where
/// that is zero or not finite the difference quotient over 1/1000 voxel, central or else one-sided; where that fails
/// too, zero. \param t where each edge is crossed. \param hermite gets the normals, from number `first` on.
void findRootNormals(const Field& field, const LatticeFrame& frame, const EdgeBatch& edges, const double* t,
                     HermiteBlock& hermite, std::size_t first);

}  // namespace pdc::detail
