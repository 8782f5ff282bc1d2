#include "field/simplex_kernel.h"

#include <algorithm>
#include <cmath>

namespace pdc::detail {
namespace {

/// Directions of the corner gradients: to the middles of a cube's edges.
constexpr Vec3d kEdges[12] = {{0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1},  //
                              {1, 0, 1}, {1, 0, -1}, {-1, 0, 1}, {-1, 0, -1},  //
                              {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}};

/// A corner reaches as far as the simplex is high, so that it ends where its simplices do.
constexpr double kReachSquared = 0.5;

/// The largest sum of four corners, each with the gradient that suits it best, is 0.0130072: found by search from 3·10⁶
/// samples of the simplex.
constexpr double kNormalize = 1 / 0.01301;

/// Lattice coordinates beyond this are cut off; int has room for them and their neighbours.
constexpr double kFarthest = 1 << 30;

/// Invertible, and every bit of the result depends on every bit of h (multipliers: C. Wellons, "lowbias32").
constexpr std::uint32_t mix(std::uint32_t h) {
  h = (h ^ (h >> 16)) * 0x7feb352dU;
  h = (h ^ (h >> 15)) * 0x846ca68bU;
  return h ^ (h >> 16);
}

struct LatticePoint {
  int x, y, z;
};

const Vec3d& cornerGradient(const LatticePoint& corner, std::uint32_t seed) {
  // Odd multipliers, so that neighbours differ before mixing.
  const std::uint32_t h =
      mix(seed + static_cast<std::uint32_t>(corner.x) * 0x9e3779b1U +
          static_cast<std::uint32_t>(corner.y) * 0x85ebca77U + static_cast<std::uint32_t>(corner.z) * 0xc2b2ae3dU);
  return kEdges[((h >> 16) * 12U) >> 16];
}

/// Written so that NaN, too, ends inside.
int latticeFloor(double x) {
  const double inside = x > -kFarthest ? (x < kFarthest ? x : kFarthest) : -kFarthest;
  const int towardsZero = static_cast<int>(inside);
  return towardsZero - (inside < towardsZero ? 1 : 0);
}

/// Adds one corner at offset d: t⁴ (g·d) with t = max(0, 1/2 - d·d).
void addCorner(const Vec3d& d, const Vec3d& g, ValueGradient& sum) {
  const double t = std::max(0.0, kReachSquared - dot(d, d));
  const double t3 = t * t * t, along = dot(g, d);
  sum.value += t3 * t * along;
  sum.gradient += g * (t3 * t) - d * (8 * t3 * along);
}

}  // namespace

ValueGradient simplexOctave(const Vec3d& p, std::uint32_t seed) {
  // Skewed so that the tetrahedra of a cube's six become those between (0,0,0) and (1,1,1).
  const double skew = (p.x + p.y + p.z) / 3;
  const LatticePoint base{latticeFloor(p.x + skew), latticeFloor(p.y + skew), latticeFloor(p.z + skew)};
  const double unskew = (static_cast<double>(base.x) + base.y + base.z) / 6;
  const Vec3d offset{p.x - (base.x - unskew), p.y - (base.y - unskew), p.z - (base.z - unskew)};

  // From corner to corner, one step along each axis, in the order of the offsets, largest first.
  const int xBeforeY = offset.x >= offset.y, yBeforeZ = offset.y >= offset.z, xBeforeZ = offset.x >= offset.z;
  const LatticePoint rank{2 - xBeforeY - xBeforeZ, 1 + xBeforeY - yBeforeZ, xBeforeZ + yBeforeZ};
  ValueGradient sum{0, {}};
  for (int steps = 0; steps < 4; ++steps) {
    const LatticePoint moved{rank.x < steps, rank.y < steps, rank.z < steps};
    const double back = steps / 6.0;
    addCorner({offset.x - moved.x + back, offset.y - moved.y + back, offset.z - moved.z + back},
              cornerGradient({base.x + moved.x, base.y + moved.y, base.z + moved.z}, seed), sum);
  }
  return {sum.value * kNormalize, sum.gradient * kNormalize};
}

std::uint32_t octaveSeed(std::uint32_t seed, int octave) {
  return mix(mix(seed) + static_cast<std::uint32_t>(octave) * 0x9e3779b1U);
}

}  // namespace pdc::detail
