#pragma once

#include "pdc/sample/hermite_source.h"
#include "sample/stencils/gradient_stencil.h"

namespace pdc::detail {

/// What HermiteSource::fillHermite() promises, from the values about a block: fillFromStencil(), in world space, and
/// crossings beside points on the isovalue.
void fillBlockHermite(const GradientStencil& stencil, const SurfaceBlock& block, const SlopeLimits& limits,
                      const LatticeMap& map, HermiteBlock& hermite);

/// From gradients in lattice units to directions of normals: scaled to lattice units, in which gradients are as large
/// as differences of values.
[[nodiscard]] inline Mat3d normalMapAt(const LatticeMap& map, const Vec3d& x) {
  return inverse(map.jacobian(x)).transposed() * map.voxelSize();
}

}  // namespace pdc::detail
