#include "extract/crossing_rows.h"

#include <algorithm>

#include "math/lane_loops.h"

namespace pdc::detail {

std::size_t CrossingRows::fill(const HermiteBlock& hermite, const EdgeIndex& edges, const CellMetric& metric,
                               const LatticeMap& map, const Vec3d& origin, SimdLevel level) {
  const Mat3d Mt = metric.M.transposed();
  std::size_t withoutNormal = 0;
  mRow[0] = Float16{};
  const auto inLattice = [&](const Vec3f& n, const Vec3f& place) {
    if (map.affine()) return vecCast<float>(Mt * vecCast<double>(n));
    const Vec3d p = origin + vecCast<double>(place);
    return vecCast<float>(map.jacobian(p).transposed() * vecCast<double>(n) * (1 / metric.voxelSize));
  };
  forEachBlock(level, 3, [&](std::size_t axis) {
    for (int i = edges.begin(int(axis)); i < edges.begin(int(axis) + 1); ++i) {
      const int point = edges.points()[i], x = point >> 8, y = point >> 4 & 15, z = point & 15;
      const float t = hermite.t[i];
      const float px = static_cast<float>(x) + (axis == 0 ? t : 0.0F),
                  py = static_cast<float>(y) + (axis == 1 ? t : 0.0F),
                  pz = static_cast<float>(z) + (axis == 2 ? t : 0.0F);
      Vec3f n{hermite.nx[i], hermite.ny[i], hermite.nz[i]};
      withoutNormal += std::size_t{n == Vec3f{} && x < kBlockSize && y < kBlockSize && z < kBlockSize};
      if (!metric.identity) n = inLattice(n, {px, py, pz});
      const Float4 r = float4(n);
      const float along = t * (axis == 0 ? n.x : axis == 1 ? n.y : n.z);
      // Straight from registers: a row put together in memory would have to wait for its parts.
      constexpr Float4 kLast{0.0F, 0.0F, 0.0F, 1.0F};
      auto* row = reinterpret_cast<float*>(&mRow[i + 1]);
      store(r * n.x + kLast * px, row);
      store(r * n.y + kLast * py, row + 4);
      store(r * n.z + kLast * pz, row + 8);
      store(r * along + kLast, row + 12);
      mPlane[i] = r;
    }
  });
  return withoutNormal;
}

void CrossingRows::addNoise(const PlaneNoise& noise, const HermiteBlock& hermite, const EdgeIndex& edges,
                            const CellMetric& metric, double variance) {
  const SymMat3<double> G = metric.G;
  const std::array<Vec3f, 3> column{vecCast<float>(Vec3d{G.xx, G.xy, G.xz}), vecCast<float>(Vec3d{G.xy, G.yy, G.yz}),
                                    vecCast<float>(Vec3d{G.xz, G.yz, G.zz})};
  const auto common = static_cast<float>(variance);
  for (int axis = 0; axis < 3; ++axis)
    for (int i = edges.begin(axis); i < edges.begin(axis + 1); ++i) {
      Float16& row = mRow[i + 1];
      const float own = common + noise.sigma[i] * noise.sigma[i], w = std::max(noise.weight[i], kLeastWeight);
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j) row[4 * k + j] = w * (row[4 * k + j] + own * column[k][j]);
      for (int j = 0; j < 3; ++j) row[12 + j] = hermite.t[i] * row[4 * axis + j];
      for (int k = 0; k < 4; ++k) row[4 * k + 3] *= w;
    }
}

}  // namespace pdc::detail
