#include "extract/vertices/cell_rounding.h"

#include <algorithm>
#include <cmath>

#include "extract/vertices/vertex_solver.h"

namespace pdc::detail {

double cellRounding(const LatticeMap& map, const Coord& block) {
  constexpr double kMiddle = kBlockSize / 2.0;
  const Vec3d at{kBlockSize * block[0] + kMiddle, kBlockSize * block[1] + kMiddle, kBlockSize * block[2] + kMiddle};
  const Vec3d p = map.position(at);
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) + 2 * kBlockSize * map.voxelSize();
  const Mat3d K = inverse(map.jacobian(at));
  double rounding = 0;
  for (const Vec3d& row : K.row)
    rounding = std::max(rounding,
                        (std::abs(row.x) + std::abs(row.y) + std::abs(row.z)) * (largest * 0x1p-24 + 0.5 * map.step()));
  return rounding;
}

double roundedCellHalfSize(const LatticeMap& map, const Coord& block) {
  return 0.5 - std::clamp(4 * cellRounding(map, block), kCellMargin, 0.25);
}

}  // namespace pdc::detail
