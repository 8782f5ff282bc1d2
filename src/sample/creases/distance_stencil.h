#pragma once

#include <array>
#include <cstdint>

#include "pdc/math/quadric_lanes.h"
#include "pdc/math/sym_mat3.h"
#include "pdc/sample/hermite_block.h"

namespace pdc::detail {

/// A block's points and three beyond on every side, -3 to 11 on each axis, as distances in voxels that are negative
/// inside; NaN where the grid does not say. Along z there is one more below, so that rows are whole blocks of lanes.
struct DistanceStencil {
  static constexpr int kReach = 3, kPoints = kBlockPoints + 2 * kReach;
  static constexpr int kBelow = kReach + 1, kAbove = kReach + 1;  ///< The block's own eight along z.
  static_assert(kBelow + kBlockSize + kAbove == kLanes);
  static constexpr std::array<int, 3> kStep{kPoints * kLanes, kLanes, 1};

  static constexpr int index(int x, int y, int z) {
    return (kPoints * (x + kReach) + y + kReach) * kLanes + z + kBelow;
  }

  using Rows = std::array<std::uint16_t, kPoints>;
  static constexpr Rows allRows() {
    Rows rows{};
    rows.fill((1U << kPoints) - 1);
    return rows;
  }

  Rows rows = allRows();  ///< The rows along z that are to be read: by x + kReach, bit y + kReach.
  alignas(64) std::array<float, kPoints * kPoints * kLanes> value;
};

}  // namespace pdc::detail
