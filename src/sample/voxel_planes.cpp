#include "sample/voxel_planes.h"

#include <algorithm>
#include <cmath>

#include "sample/kinks.h"

namespace pdc::detail {
namespace {

/// Mixed second differences up to this are curvature, not a crease that cuts through an octant.
constexpr float kCurvature = 0.04F;

/// Slopes along one axis to take into an octant's gradient: seen from below and from above.
struct Slopes {
  std::array<float, 2> slope;
  bool kinked;
};

Slopes slopesAt(const float* p, int step, float kink) {
  const OneSidedSlopes s(p, step);
  if (!(std::abs(s.above - s.below) <= kink)) return {{s.below, s.above}, true};
  // Where both agree, the central difference is the most exact.
  const float central = 0.5F * (p[step] - p[-step]);
  return {{central, central}, false};
}

/// By how much a face diagonal of each of the four quadrants misses what its sides predict; index su + 2 sv.
std::array<float, 4> mixedDifferences(const float* p, int u, int v) {
  std::array<float, 4> out;
  for (int k = 0; k < 4; ++k) {
    const int su = (k & 1) != 0 ? u : -u, sv = (k & 2) != 0 ? v : -v;
    out[k] = std::abs(p[su + sv] - p[su] - p[sv] + p[0]);
  }
  return out;
}

}  // namespace

VoxelPlanes voxelPlanes(const DistanceWindow& window, const Coord& voxel, const PlaneTolerance& tolerance,
                        const Mat3f& K) {
  constexpr auto step = DistanceWindow::kStep;
  const float* p = &window.value[DistanceWindow::index(voxel[0], voxel[1], voxel[2])];
  const Vec3f at{float(voxel[0]), float(voxel[1]), float(voxel[2])};
  const Mat3f Kt = K.transposed();
  VoxelPlanes out;
  std::array<Slopes, 3> axis;
  int kinked = 0;
  for (int i = 0; i < 3; ++i) {
    axis[i] = slopesAt(p, step[i], tolerance.kink);
    kinked |= int(axis[i].kinked) << i;
  }
  const auto xy = mixedDifferences(p, step[0], step[1]), yz = mixedDifferences(p, step[1], step[2]),
             xz = mixedDifferences(p, step[0], step[2]);
  // Octants with the same slopes: the one whose diagonals fit best speaks for all.
  std::array<float, 8> error;
  error.fill(tolerance.error);
  for (int o = 0; o < 8; ++o) {
    const float a = xy[o & 3], b = yz[o >> 1], c = xz[(o & 1) | (o >> 1 & 2)];
    const float missed = a + b + c == a + b + c ? std::max({a, b, c, kCurvature}) - kCurvature : tolerance.error;
    error[o & kinked] = std::min(error[o & kinked], missed);
  }
  for (int o = 0; o < 8; ++o) {
    if ((o & ~kinked) != 0 || !(error[o] < tolerance.error)) continue;
    const Vec3f r{axis[0].slope[o & 1], axis[1].slope[o >> 1 & 1], axis[2].slope[o >> 2]};
    const Vec3f g = Kt * r;
    const float l = length(g);
    const float e = std::max(error[o], std::abs(l - 1)) / tolerance.error;
    if (!(e < 1)) continue;
    const Vec3f n = g * (1 / l);
    const float weight = (1 - e * e) * (1 - e * e), excess = e * tolerance.error / tolerance.usual,
                damping = 1 + excess * excess;
    const SurfaceSample sample{n, at - K * n * p[0], weight, weight / (damping * damping)};
    if (out.count < VoxelPlanes::kMax) {
      out.plane[out.count++] = sample;
    } else {
      auto* worst = std::min_element(out.plane.begin(), out.plane.end(),
                                     [](const auto& a, const auto& b) { return a.weight < b.weight; });
      if (worst->weight < sample.weight) *worst = sample;
    }
  }
  return out;
}

}  // namespace pdc::detail
