#include "extract/crossing_rows.h"

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

}  // namespace pdc::detail
