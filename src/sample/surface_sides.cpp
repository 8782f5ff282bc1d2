#include "sample/surface_sides.h"

#include <algorithm>
#include <cmath>

#include "pdc/math/solvers.h"

namespace pdc::detail {
namespace {

/// Normals within 26° of a side's mean belong to it.
constexpr float kSameSide = 0.9F;
/// Samples lighter than this found no side of their own.
constexpr float kLeastSeed = 0.02F;
/// Curvatures that are common, per voxel: noise in the normals that would look larger is smoothed away.
constexpr double kUsualBend = 0.1;

SurfaceSide fitSide(std::span<const SurfaceSample> samples, std::span<const int> members, double normalNoise) {
  SurfaceSide side{{}, {}, {}, 0, 0};
  double trust = 0;
  for (const int i : members) {
    const SurfaceSample& s = samples[i];
    side.weight += s.weight;
    trust += s.trust;
    side.center += vecCast<double>(s.foot) * double(s.trust);
    side.normal += vecCast<double>(s.normal) * double(s.trust);
  }
  side.center *= 1 / trust;
  const Vec3d mean = side.normal * (1 / trust);
  side.normal *= 1 / length(side.normal);

  // Least squares for n(p) − mean = H(p − center), with a ridge.
  SymMat3<double> spread = SymMat3<double>::zero();
  Mat3d turn{{Vec3d{}, Vec3d{}, Vec3d{}}};
  for (const int i : members) {
    const SurfaceSample& s = samples[i];
    const Vec3d d = vecCast<double>(s.foot) - side.center, dn = (vecCast<double>(s.normal) - mean) * double(s.trust);
    spread += outer(d) * double(s.trust);
    for (int k = 0; k < 3; ++k) turn.row[k] += d * dn[k];
  }
  const double noise = normalNoise / kUsualBend;
  const SymMat3<double> damped = spread.plusDiagonal((0.01 + noise * noise) * trust);
  for (int k = 0; k < 3; ++k) {
    const auto row = solveLdlt(damped, turn.row[k]);
    side.bend.row[k] = row ? *row : Vec3d{};
  }
  // Only the tangential, symmetric part can be curvature.
  const Vec3d n = side.normal;
  Mat3d P;
  for (int k = 0; k < 3; ++k) P.row[k] -= n * n[k];
  const Mat3d t = side.bend.transposed();
  for (int k = 0; k < 3; ++k) side.bend.row[k] = (side.bend.row[k] + t.row[k]) * 0.5;
  side.bend = P * side.bend * P;
  double bent = 0;
  for (const int i : members) {
    const Vec3d d = vecCast<double>(samples[i].foot) - side.center;
    bent += 0.5 * dot(d, side.bend * d) * double(samples[i].trust);
  }
  side.offset = bent / trust;
  return side;
}

}  // namespace

SurfaceSides findSides(std::span<const SurfaceSample> samples, double normalNoise) {
  constexpr int kMost = 64 * VoxelPlanes::kMax;
  std::array<bool, kMost> taken{};
  std::array<int, kMost> members;
  SurfaceSides sides;
  const int n = static_cast<int>(samples.size());
  while (sides.count < SurfaceSides::kMax) {
    int seed = -1;
    for (int i = 0; i < n; ++i)
      if (!taken[i] && samples[i].weight > kLeastSeed && (seed < 0 || samples[i].trust > samples[seed].trust)) seed = i;
    if (seed < 0) break;
    Vec3f mean = samples[seed].normal;
    for (int pass = 0; pass < 2; ++pass) {
      Vec3f sum{};
      for (int i = 0; i < n; ++i)
        if (!taken[i] && dot(samples[i].normal, mean) > kSameSide) sum += samples[i].normal * samples[i].trust;
      if (length(sum) > 0) mean = sum * (1 / length(sum));
    }
    int count = 0;
    for (int i = 0; i < n; ++i)
      if (!taken[i] && (i == seed || dot(samples[i].normal, mean) > kSameSide)) {
        taken[i] = true;
        members[count++] = i;
      }
    sides.side[sides.count++] = fitSide(samples, std::span(members).first(std::size_t(count)), normalNoise);
  }
  return sides;
}

Vec3d meetingPoint(const SurfaceSides& sides, const Vec3d& start, double sigma) {
  constexpr int kSteps = 3;
  Vec3d y = start;
  for (int step = 0; step < kSteps; ++step) {
    const double ridge = sigma * sigma * sides.count;
    SymMat3<double> A = SymMat3<double>::identity() * ridge;
    Vec3d b = (start - y) * ridge;
    for (int i = 0; i < sides.count; ++i) {
      const SurfaceSide& s = sides.side[i];
      const double w = std::min(s.weight, 1.0);
      const Vec3d g = s.gradient(y);
      A += outer(g) * w;
      b -= g * (w * s.value(y));
    }
    const auto d = solveLdlt(A, b);
    if (!d) break;
    y += *d;
  }
  return y;
}

}  // namespace pdc::detail
