#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// The sums of a mesh's origin and its positions.
[[nodiscard]] inline Buffer<Vec3d> worldPositions(const Mesh& mesh) {
  Buffer<Vec3d> world(mesh.positions.size());
  tbb::parallel_for(std::size_t{0}, world.size(),
                    [&](std::size_t i) { world[i] = mesh.origin + vecCast<double>(mesh.positions[i]); });
  return world;
}

}  // namespace pdc::detail
