#include "sample/normal_noise_histogram.h"

#include <cmath>

#include "math/lane_loops.h"

namespace pdc::detail {
namespace {

/// The median of the size of a number that is distributed normally, with deviation 1.
constexpr double kMedian = 0.6745;
/// The deviation of s over that of a normal's component, where values have white noise, which neighbours share: 1.6 to
/// 1.9 on the smooth kinds of bench/kinds_eval with noise of 0.02 to 0.2 voxel.
constexpr double kResidualPerNormal = 1.7;

/// Lower end points are packed as 256x + 16y + z.
float stepAlong(std::int32_t from, std::int32_t to, int shift) {
  return static_cast<float>((to >> shift & 15) - (from >> shift & 15));
}

}  // namespace

void NormalNoiseHistogram::add(const HermiteBlock& hermite, const EdgeIndex& edges, const Mat3f& M, SimdLevel level) {
  constexpr std::int32_t kNoPair = -1;
  for (const Axis axis : kAxes) {
    const int begin = edges.begin(axis), pairs = edges.begin(axis + 1) - begin - 1;
    if (pairs <= 0) continue;
    const float isX = axis == kAxisX ? 1.0F : 0.0F, isY = axis == kAxisY ? 1.0F : 0.0F,
                isZ = axis == kAxisZ ? 1.0F : 0.0F;
    forEachBatch(level, batchCount(static_cast<std::size_t>(pairs)), [&](std::size_t batch) {
      const int first = begin + static_cast<int>(batch) * kLanes, left = begin + pairs - first;
      const std::uint16_t* point = edges.points() + first;
      const float *t = &hermite.t[first], *nx = &hermite.nx[first], *ny = &hermite.ny[first], *nz = &hermite.nz[first];
      alignas(64) std::int32_t bin[kLanes];
      forEachLane([&, M, isX, isY, isZ, left](int i) {
        const std::int32_t p = point[i], q = point[i + 1];
        const float dx = stepAlong(p, q, 8), dy = stepAlong(p, q, 4), dz = stepAlong(p, q, 0);
        const float along = t[i + 1] - t[i], steps = std::abs(dx) + std::abs(dy) + std::abs(dz);
        const Vec3f chord = M * Vec3f{dx + isX * along, dy + isY * along, dz + isZ * along};
        const Vec3f a{nx[i], ny[i], nz[i]}, b{nx[i + 1], ny[i + 1], nz[i + 1]};
        const float across = dot(a + b, chord), squared = across * across / dot(chord, chord);
        // Crossings on the two sides of something thin may be neighbours too.
        const bool pair = (steps < 1.5F) & (dot(a, b) > 0) & (i < left);
        const std::int32_t place = RootHistogram::bin(squared);
        bin[i] = pair ? place : kNoPair;
      });
      for (const std::int32_t b : bin)
        if (b != kNoPair) mSizes.count(b);
    });
  }
}

double NormalNoiseHistogram::sigma(std::uint64_t certain) const {
  return mSizes.median(certain) / (kMedian * kResidualPerNormal);
}

}  // namespace pdc::detail
