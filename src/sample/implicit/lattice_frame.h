#pragma once

#include "pdc/math/vec3.h"

namespace pdc::detail {

/// A uniform lattice in world space. Positions follow from the lattice coordinate alone, so whoever asks for a point,
/// from whichever block, gets the same bits.
struct LatticeFrame {
  Vec3d origin;
  double voxelSize;

  [[nodiscard]] double at(int axis, double coordinate) const { return origin[axis] + voxelSize * coordinate; }
};

}  // namespace pdc::detail
