#pragma once

#include <array>
#include <bitset>
#include <cstdint>

#include "pdc/math/simd_level.h"
#include "sample/creases/distance_stencil.h"

namespace pdc::detail {

/// The points of a block whose slopes from both sides are known and differ along some axis: a crease's bisector passes
/// by. They are found a row at a time, as they are asked for.
class GradientJumps {
 public:
  /// \param stencil must outlive this. \param tolerance by how much slopes may differ. \param level changes no bit of
  /// it.
  GradientJumps(const DistanceStencil& stencil, float tolerance, SimdLevel level = bestSimdLevel())
      : mStencil(stencil), mTolerance(tolerance), mLevel(level) {}

  /// True if there are none at the corners of a cell. A bisector that passes between them is next to one.
  [[nodiscard]] bool noneAt(const Coord& cell);

 private:
  void find(int row);

  const DistanceStencil& mStencil;
  float mTolerance;
  SimdLevel mLevel;
  std::bitset<kBlockPoints * kBlockPoints> mKnown;
  std::array<std::uint16_t, kBlockPoints * kBlockPoints> mRow;  ///< Row 9x + y, bit z.
};

}  // namespace pdc::detail
