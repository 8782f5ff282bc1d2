#pragma once

#include <array>

#include "pdc/math/sym_mat3.h"
#include "pdc/sample/hermite_block.h"

namespace pdc::detail {

/// A block's points and three beyond on every side, -3 to 11 on each axis, as distances in voxels that are negative
/// inside; NaN where the grid does not say.
struct DistanceWindow {
  static constexpr int kReach = 3, kPoints = kBlockPoints + 2 * kReach;
  static constexpr std::array<int, 3> kStep{kPoints * kPoints, kPoints, 1};

  static constexpr int index(int x, int y, int z) {
    return (kPoints * (x + kReach) + y + kReach) * kPoints + z + kReach;
  }

  std::array<float, kPoints * kPoints * kPoints> value;
};

}  // namespace pdc::detail
