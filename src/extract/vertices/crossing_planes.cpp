#include "extract/vertices/crossing_planes.h"

#include <algorithm>

#include "math/lane_loops.h"

namespace pdc::detail {
namespace {

/// Edges of the block itself, not of its upper neighbours, whose normal is zero.
std::size_t countWithoutNormal(const HermiteBlock& hermite, const EdgeIndex& edges) {
  std::size_t n = 0;
  edges.forEach([&](int i, int /*axis*/, int x, int y, int z) {
    const bool own = x < kBlockSize && y < kBlockSize && z < kBlockSize;
    n += std::size_t{own && Vec3f{hermite.nx[i], hermite.ny[i], hermite.nz[i]} == Vec3f{}};
  });
  return n;
}

}  // namespace

std::size_t CrossingPlanes::fill(const HermiteBlock& hermite, const EdgeIndex& edges, const CellMetric& metric,
                                 const LatticeMap& map, const Vec3d& origin, SimdLevel level) {
  alignas(64) int none[kLanes]{};
  const std::size_t blocks = batchCount(static_cast<std::size_t>(edges.size()));
  forEachBatch(level, blocks, [&](std::size_t block) {
    const std::size_t first = block * kLanes;
    for (std::size_t i = first; i < first + kLanes; i += 4)
      transpose4({&hermite.nx[i], &hermite.ny[i], &hermite.nz[i], &hermite.t[i]}, mRow[i].data(), 4);
    const float *nx = &hermite.nx[first], *ny = &hermite.ny[first], *nz = &hermite.nz[first];
    forEachLane([&](int i) { none[i] |= int(nx[i] == 0) & int(ny[i] == 0) & int(nz[i] == 0); });
  });
  if (!metric.identity) {
    const Mat3d Mt = metric.M.transposed();
    edges.forEach([&](int i, int axis, int x, int y, int z) {
      const Vec3d n{hermite.nx[i], hermite.ny[i], hermite.nz[i]};
      Vec3d place{double(x), double(y), double(z)};
      place[axis] += hermite.t[i];
      const Vec3f r = vecCast<float>(
          map.affine() ? Mt * n : map.jacobian(origin + place).transposed() * n * (1 / metric.voxelSize));
      for (int k = 0; k < 3; ++k) mRow[i][k] = r[k];
    });
  }
  // What lies beyond the last edge may be anything.
  return std::ranges::any_of(none, [](int n) { return n != 0; }) ? countWithoutNormal(hermite, edges) : 0;
}

void CrossingPlanes::setNoise(const PlaneNoise& noise, const EdgeIndex& edges, double variance) {
  const auto common = static_cast<float>(variance);
  for (int i = 0; i < edges.size(); ++i) {
    const float w = std::max(noise.weight[i], kLeastWeight);
    mNoise[i] = {w, w * (common + noise.sigma[i] * noise.sigma[i])};
  }
}

}  // namespace pdc::detail
