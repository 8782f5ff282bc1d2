#pragma once

#include "pdc/math/vec3.h"
#include "pdc/sample/lattice.h"

namespace pdc::detail {

/// The lowest point of a block.
[[nodiscard]] inline Vec3d blockOrigin(const Coord& block) {
  return {double(kBlockSize) * block[0], double(kBlockSize) * block[1], double(kBlockSize) * block[2]};
}

}  // namespace pdc::detail
