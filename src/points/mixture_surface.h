#pragma once

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"
#include "points/mixture_field.h"

namespace pdc::detail {

/// Contours the ridge of a mixture (see MixtureField) with the deviations of its normals, on the lattice of the
/// multiples of `voxelSize`. Parts that are smaller than 8σ0 are dropped if there is a larger one.
/// \param rough closed triangles near the ridge; what they enclose is inside.
/// \param dropped how many parts were.
/// \returns what contour() promises. \throws Error if nothing is enclosed, and as meshToLevelSet() and contour() do.
[[nodiscard]] Mesh contourMixture(const GaussianMixture& mixture, const MixtureScale& scale, const Mesh& rough,
                                  double voxelSize, std::size_t& dropped, const Monitor& monitor);

}  // namespace pdc::detail
