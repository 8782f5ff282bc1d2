#pragma once

#include <algorithm>
#include <cstdint>

#include "field/pointwise_field.h"

namespace pdc::detail {

/// What simplexOctave() is made of.
namespace simplex {

/// The square of the distance that a corner reaches: a simplex's height, so that it ends where its simplices do.
inline constexpr double kReachSquared = 0.5;

/// The largest sum of four corners, each with the gradient that makes it largest, is 0.0130072, found by search from
/// 3·10⁶ samples of the simplex.
inline constexpr double kNormalize = 1 / 0.01301;

/// Lattice coordinates are cut off beyond this, so that int has room for them and their neighbours.
inline constexpr double kFarthest = 1 << 30;

/// An invertible hash in which every bit of the result depends on every bit of h (multipliers: C. Wellons,
/// "lowbias32").
constexpr std::uint32_t mix(std::uint32_t h) {
  h = (h ^ (h >> 16)) * 0x7feb352dU;
  h = (h ^ (h >> 15)) * 0x846ca68bU;
  return h ^ (h >> 16);
}

struct LatticePoint {
  int x, y, z;
};

/// One of the twelve vectors from a cube's centre to the middles of its edges, chosen by hash.
inline Vec3d cornerGradient(const LatticePoint& corner, std::uint32_t seed) {
  // The multipliers are odd, so that neighbours differ before mixing.
  const std::uint32_t h =
      mix(seed + static_cast<std::uint32_t>(corner.x) * 0x9e3779b1U +
          static_cast<std::uint32_t>(corner.y) * 0x85ebca77U + static_cast<std::uint32_t>(corner.z) * 0xc2b2ae3dU);
  const std::uint32_t edge = ((h >> 16) * 12U) >> 16, axis = edge >> 2;
  const double a = (edge & 1) != 0 ? -1 : 1, b = (edge & 2) != 0 ? -1 : 1;
  return {axis == 0 ? 0 : (axis == 1 ? b : a), axis == 0 ? a : (axis == 1 ? 0 : b),
          axis == 0 ? b : (axis == 1 ? a : 0)};
}

/// The largest integer not above x; the comparisons are such that NaN becomes an int too.
inline int latticeFloor(double x) {
  const double inside = x > -kFarthest ? (x < kFarthest ? x : kFarthest) : -kFarthest;
  const int towardsZero = static_cast<int>(inside);
  return towardsZero - (inside < towardsZero ? 1 : 0);
}

/// Adds what one corner contributes at offset d from it, t⁴ (g·d) with t = max(0, 1/2 - d·d), and its gradient.
inline void addCorner(const Vec3d& d, const Vec3d& g, ValueGradient& sum) {
  const double t = std::max(0.0, kReachSquared - dot(d, d));
  const double t3 = t * t * t, along = dot(g, d);
  sum.value += t3 * t * along;
  sum.gradient += g * (t3 * t) - d * (8 * t3 * along);
}

}  // namespace simplex

/// One octave of simplex noise at unit frequency: in [-1, 1], three times continuously differentiable. Lattices of
/// different seeds are independent. Beyond 2^30 lattice cells from the origin it is zero. There are no branches, so
/// that loops over it vectorise.
inline ValueGradient simplexOctave(const Vec3d& p, std::uint32_t seed) {
  using namespace simplex;
  // Skewing turns the simplices into the six tetrahedra that share a cube's diagonal from (0,0,0) to (1,1,1).
  const double skew = (p.x + p.y + p.z) / 3;
  const LatticePoint base{latticeFloor(p.x + skew), latticeFloor(p.y + skew), latticeFloor(p.z + skew)};
  const double unskew = (static_cast<double>(base.x) + base.y + base.z) / 6;
  const Vec3d offset{p.x - (base.x - unskew), p.y - (base.y - unskew), p.z - (base.z - unskew)};

  // The simplex's corners follow each other by one step along each axis, in the order of the offsets, largest first.
  const int xBeforeY = offset.x >= offset.y, yBeforeZ = offset.y >= offset.z, xBeforeZ = offset.x >= offset.z;
  const LatticePoint rank{2 - xBeforeY - xBeforeZ, 1 + xBeforeY - yBeforeZ, xBeforeZ + yBeforeZ};
  ValueGradient sum{0, {}};
  const auto addAfter = [&](int steps) {
    const LatticePoint moved{rank.x < steps, rank.y < steps, rank.z < steps};
    const double back = steps / 6.0;
    addCorner({offset.x - moved.x + back, offset.y - moved.y + back, offset.z - moved.z + back},
              cornerGradient({base.x + moved.x, base.y + moved.y, base.z + moved.z}, seed), sum);
  };
  addAfter(0);
  addAfter(1);
  addAfter(2);
  addAfter(3);
  return {sum.value * kNormalize, sum.gradient * kNormalize};
}

/// The seed of an octave, which shows no relation to those of the others.
inline std::uint32_t octaveSeed(std::uint32_t seed, int octave) {
  using simplex::mix;
  return mix(mix(seed) + static_cast<std::uint32_t>(octave) * 0x9e3779b1U);
}

/// Upper bounds of the length of an octave's gradient and of the norm of its second derivative. The maxima over the
/// simplex and all choices of corner gradients, found by search from 3·10⁵ and 3·10⁴ samples, are 6.9654 and 48.241.
inline constexpr double kSimplexSlope = 7.0;
inline constexpr double kSimplexCurvature = 49.0;

}  // namespace pdc::detail
