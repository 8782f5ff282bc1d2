#include "sample/creases/gradient_jumps.h"

#include <cmath>

#include "math/lane_loops.h"
#include "sample/creases/one_sided_slopes.h"

namespace pdc::detail {

void GradientJumps::find(int row) {
  static_assert(kLanes >= kBlockPoints);
  // The last rows' lanes read beyond what they need, but not beyond the stencil: it has three more planes of points.
  static_assert(DistanceStencil::index(8, 8, 0) + kLanes + 2 * DistanceStencil::kStep[0] <=
                DistanceStencil::index(11, 11, 11) + 1);
  const float* first = &mStencil.value[DistanceStencil::index(row / kBlockPoints, row % kBlockPoints, 0)];
  const float tolerance = mTolerance;
  withSimd(mLevel, [&] {
    std::array<std::int32_t, kLanes> jumping;
    forEachLane([&](int lane) {
      std::int32_t any = 0;
      for (const int step : DistanceStencil::kStep) {
        const OneSidedSlopes s(first + lane, step);
        any |= std::int32_t(std::abs(s.above - s.below) > tolerance);
      }
      jumping[lane] = any;
    });
    unsigned bits = 0;
    for (int z = 0; z < kBlockPoints; ++z) bits |= static_cast<unsigned>(jumping[z]) << z;
    mRow[row] = static_cast<std::uint16_t>(bits);
  });
  mKnown.set(static_cast<std::size_t>(row));
}

bool GradientJumps::noneAt(const Coord& cell) {
  unsigned any = 0;
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y) {
      const int row = kBlockPoints * (cell[0] + x) + cell[1] + y;
      if (!mKnown.test(static_cast<std::size_t>(row))) find(row);
      any |= mRow[row];
    }
  return (any >> cell[2] & 3) == 0;
}

}  // namespace pdc::detail
