#include "extract/vertices/cell_metric.h"

#include <algorithm>
#include <cmath>

namespace pdc::detail {

CellMetric::CellMetric(const Mat3d& jacobian, double unit)
    : voxelSize(unit), M(jacobian * (1.0 / unit)), G(congruence(SymMat3<double>::identity(), M)) {
  // A uniform scale's entries are one to rounding; making them so lets such lattices skip the metric altogether.
  constexpr double kRounding = 1e-12;
  const Mat3d I;
  double off = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3d d = M.row[i] - I.row[i];
    off = std::max({off, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  }
  identity = off < kRounding;
  if (identity) {
    M = I;
    G = SymMat3<double>::identity();
  }
}

SymMat3<double> CellMetric::inverseG() const {
  return congruence(SymMat3<double>::identity(), inverse(M).transposed());
}

CellMetric blockMetric(const LatticeMap& map, const Vec3d& origin) {
  if (map.affine()) return CellMetric(map.jacobian({}), map.voxelSize());
  constexpr double kMiddle = kBlockSize / 2.0;
  const Mat3d J = map.jacobian(origin + Vec3d{kMiddle, kMiddle, kMiddle});
  return CellMetric(J, std::cbrt(std::abs(J.determinant())));
}

}  // namespace pdc::detail
