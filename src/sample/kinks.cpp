#include "sample/kinks.h"

#include "math/lane_loops.h"

namespace pdc::detail {

Kinks findKinks(const DistanceWindow& window, float tolerance, SimdLevel level) {
  static_assert(kLanes >= Kinks::kVoxels);
  Kinks kinks;
  // The last rows' lanes read beyond what they need, but not beyond the window: it has two more planes of points.
  static_assert(DistanceWindow::index(9, 9, -1) + kLanes + 2 * DistanceWindow::kStep[0] <=
                DistanceWindow::index(11, 11, 11) + 1);
  forEachBlock(level, Kinks::kVoxels * Kinks::kVoxels, [&](std::size_t row) {
    const int x = static_cast<int>(row) / Kinks::kVoxels - 1, y = static_cast<int>(row) % Kinks::kVoxels - 1;
    const float* first = &window.value[DistanceWindow::index(x, y, -1)];
    std::array<int, kLanes> kinked;
    forEachLane([&](int lane) {
      int any = 0;
      for (const int step : DistanceWindow::kStep) {
        const OneSidedSlopes s(first + lane, step);
        any |= int(std::abs(s.above - s.below) > tolerance);
      }
      kinked[lane] = any;
    });
    unsigned bits = 0;
    for (int z = 0; z < Kinks::kVoxels; ++z) bits |= static_cast<unsigned>(kinked[z]) << z;
    kinks.mRow[row] = static_cast<std::uint16_t>(bits);
  });
  return kinks;
}

}  // namespace pdc::detail
