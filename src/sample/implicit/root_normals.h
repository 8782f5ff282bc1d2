#pragma once

#include "sample/implicit/edge_roots.h"

namespace pdc::detail {

/// Unit normals at the crossings: the gradient, normalised; where that is zero or not finite the difference quotient
/// over 1/1000 voxel, central or else one-sided; where that fails too, zero.
void findRootNormals(const Field& field, const LatticeFrame& frame, const EdgeBatch& edges, const double* t, float* nx,
                     float* ny, float* nz);

}  // namespace pdc::detail
