#include "sample/stencils/block_hermite.h"

#include <cmath>

#include "sample/stencils/isovalue_points.h"

namespace pdc::detail {
namespace {

/// Turns the gradients of a map that is not affine, which are in `hermite` in lattice units, into normals.
void mapNormals(const Coord& block, const EdgeIndex& edges, const LatticeMap& map, HermiteBlock& hermite) {
  edges.forEach([&](int i, int axis, int x, int y, int z) {
    Vec3d at{8.0 * block[0] + x, 8.0 * block[1] + y, 8.0 * block[2] + z};
    at[axis] += hermite.t[i];
    const Vec3d g = normalMapAt(map, at) * Vec3d{hermite.nx[i], hermite.ny[i], hermite.nz[i]};
    const double l = length(g);
    const Vec3f n = vecCast<float>(l > 0 && std::isfinite(l) ? g * (1 / l) : Vec3d{});
    hermite.nx[i] = n.x;
    hermite.ny[i] = n.y;
    hermite.nz[i] = n.z;
  });
}

}  // namespace

void fillBlockHermite(const GradientStencil& stencil, const SurfaceBlock& block, const SlopeLimits& limits,
                      const LatticeMap& map, HermiteBlock& hermite) {
  if (map.affine()) {
    fillFromStencil(stencil, block.edges, limits, matCast<float>(normalMapAt(map, {})), hermite);
  } else {
    fillFromStencil(stencil, block.edges, limits, Mat3f::identity(), hermite);
    mapNormals(block.coord, block.edges, map, hermite);
  }
  placeIsovalueCrossings(stencil, block.signs, block.edges, hermite);
}

}  // namespace pdc::detail
