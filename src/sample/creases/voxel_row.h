#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "math/lane_loops.h"
#include "sample/creases/distance_stencil.h"
#include "sample/creases/one_sided_slopes.h"

/// What the values about a row of voxels say of each voxel's octants: the eight combinations of slopes from below and
/// above. Octant o takes the slope from above along axis a where bit a of o is set.
namespace pdc::detail {

inline constexpr int kOctants = 8;

/// A row of voxels along z, a voxel per lane.
struct VoxelRow {
  /// Lanes by twice the axis, from below, and from above at one more.
  alignas(64) std::array<float, 3 * 2 * kLanes> slope;
  /// Lanes by octant: how far its face diagonals are from what its slopes predict. See findOctants().
  std::array<float, kOctants * kLanes> residual;
  /// By axis: infinite where the two slopes differ, 0 elsewhere.
  std::array<std::array<float, kLanes>, 3> jump;
  /// Bit o: octant o has slopes of its own, and its residual is small.
  std::array<std::int32_t, kLanes> octants;
};

/// Finds the slopes of the first voxels of a row, and where they jump. Slopes that do not are both the central
/// difference, which is the most exact. \param first of the row's values in a DistanceStencil. \param tolerance by how
/// much slopes may differ without a jump.
template <int lanes>
void findSlopes(SimdLevel level, const float* first, float tolerance, VoxelRow& row) {
  forEachBatch(level, 3, [&](std::size_t axis) {
    const int step = DistanceStencil::kStep[axis];
    float *below = &row.slope[2 * axis * kLanes], *above = below + kLanes;
    float* jump = row.jump[axis].data();
    forEachLane<lanes>([&](int lane) {
      const float* p = first + lane;
      const OneSidedSlopes s(p, step);
      const float central = centralSlope(p, step);
      const bool smooth = std::abs(s.above - s.below) <= tolerance;
      below[lane] = smooth ? central : s.below;
      above[lane] = smooth ? central : s.above;
      jump[lane] = smooth ? 0.0F : std::numeric_limits<float>::infinity();
    });
  });
}

// The functions below are the steps of findOctants() for one voxel. They become one loop of straight code, because the
// compiler unrolls shorter loops before it can vectorise them.

/// By axis and quadrant of it and the next axis, bit 0 set above on the first, bit 1 on the second: how far the value
/// on the quadrant's diagonal is from what those on its sides predict.
using QuadrantResiduals = float[3][4];
[[gnu::always_inline]] inline void findQuadrantResiduals(const float* p, QuadrantResiduals& residual) {
  constexpr auto kStep = DistanceStencil::kStep;
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 4; ++k) {
      const int u = (k & 1) != 0 ? kStep[axis] : -kStep[axis],
                v = (k & 2) != 0 ? kStep[(axis + 1) % 3] : -kStep[(axis + 1) % 3];
      residual[axis][k] = std::abs(p[u + v] - p[u] - p[v] + p[0]);
    }
}

/// The largest residual of each octant's three quadrants, as far as curvature does not explain it; `unknown` where one
/// of them is NaN.
[[gnu::always_inline]] inline void findOctantResiduals(const QuadrantResiduals& quadrant, float unknown,
                                                       float (&residual)[kOctants]) {
  constexpr float kCurvature = 0.03F;  // Mixed second differences up to this do
                                       // not mean that a crease cuts through.
  for (int o = 0; o < kOctants; ++o) {
    const float a = quadrant[0][o & 3], b = quadrant[1][o >> 1], c = quadrant[2][o >> 2 | (o & 1) << 1];
    const float ab = a < b ? b : a, abc = ab < c ? c : ab, sum = a + b + c;
    const float over = (abc < kCurvature ? kCurvature : abc) - kCurvature;
    residual[o] = sum == sum ? over : unknown;
  }
}

/// Gives the smallest residual among octants with the same slopes to one of them: the one below along all axes that do
/// not jump.
[[gnu::always_inline]] inline void joinOctants(const std::array<float, 3>& jump, float (&residual)[kOctants]) {
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < kOctants / 2; ++k) {
      const int low = (k >> axis << (axis + 1)) | (k & ((1 << axis) - 1));
      const float a = residual[low], b = residual[low | 1 << axis] + jump[axis];
      residual[low] = b < a ? b : a;
    }
}

/// The octants above along no axis without a jump: one of each set of octants with the same slopes.
[[gnu::always_inline]] inline std::int32_t distinctOctants(const std::array<float, 3>& jump) {
  constexpr std::array<std::int32_t, 3> kAbove{0b10101010, 0b11001100, 0b11110000};
  std::int32_t octants = 0b11111111;
  for (int axis = 0; axis < 3; ++axis) octants &= ~(jump[axis] == 0 ? kAbove[axis] : 0);
  return octants;
}

/// Finds which octants of the first voxels of a row have slopes of their own and residuals below `mostResidual`.
/// Residuals are those of the octants' quadrants, the smallest where octants have the same slopes; other octants' are
/// not specified. \param first as for findSlopes(), which was called before.
template <int lanes>
void findOctants(SimdLevel level, const float* first, float mostResidual, VoxelRow& row) {
  withSimd(level, [&] {
    forEachLane<lanes>([&](int lane) {
      QuadrantResiduals quadrant;
      findQuadrantResiduals(first + lane, quadrant);
      float residual[kOctants];
      findOctantResiduals(quadrant, mostResidual, residual);
      const std::array<float, 3> jump{row.jump[0][lane], row.jump[1][lane], row.jump[2][lane]};
      joinOctants(jump, residual);
      std::int32_t octants = 0;
      for (int o = 0; o < kOctants; ++o) {
        octants |= std::int32_t(residual[o] < mostResidual) << o;
        row.residual[o * kLanes + lane] = residual[o];
      }
      row.octants[lane] = octants & distinctOctants(jump);
    });
  });
}

}  // namespace pdc::detail
