#include "sample/creases/voxel_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "simd_levels.h"

namespace pdc::detail {
namespace {

constexpr float kTolerance = 0.15F, kMostResidual = 0.25F;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A stencil of a plane with errors that are mostly small, and a few unknown values.
DistanceStencil roughStencil(unsigned seed) {
  DistanceStencil stencil;
  std::mt19937 random(seed);
  std::normal_distribution<float> error(0, 0.03F);
  std::uniform_int_distribution<int> kind(0, 99);
  for (std::size_t i = 0; i < stencil.value.size(); ++i) {
    stencil.value[i] = 0.1F * static_cast<float>(i % kLanes) + error(random);
    if (kind(random) < 4) stencil.value[i] += 0.4F;
    if (kind(random) < 1) stencil.value[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return stencil;
}

/// What a voxel's octants should be, one by one.
struct Octants {
  Octants(const float* p, const std::array<bool, 3>& jumps) {
    for (int o = 0; o < kOctants; ++o) {
      int group = o;  // The octant that speaks for this one.
      for (int axis = 0; axis < 3; ++axis)
        if (!jumps[axis]) group &= ~(1 << axis);
      residual[group] = std::min(residual[group], residualOf(p, o));
    }
    for (int o = 0; o < kOctants; ++o) accepted[o] = residual[o] < kMostResidual;
  }

  static float residualOf(const float* p, int octant) {
    float largest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto step = [&](int a) {
        return (octant >> a & 1) != 0 ? DistanceStencil::kStep[a] : -DistanceStencil::kStep[a];
      };
      const int u = step(axis), v = step((axis + 1) % 3);
      const float miss = std::abs(p[u + v] - p[u] - p[v] + p[0]);
      if (std::isnan(miss)) return kMostResidual;
      largest = std::max(largest, miss);
    }
    return std::max(largest, 0.03F) - 0.03F;
  }

  std::array<float, kOctants> residual{kInfinity, kInfinity, kInfinity, kInfinity,
                                       kInfinity, kInfinity, kInfinity, kInfinity};
  std::array<bool, kOctants> accepted{};
};

/// How many octants were accepted and rejected, and how many slopes jump.
struct Counts {
  int accepted = 0, rejected = 0, jumps = 0;
};

template <int lanes>
void expectPlainSlopesAndOctants(unsigned seed, SimdLevel level, Counts& counts) {
  const auto stencil = std::make_unique<DistanceStencil>(roughStencil(seed));
  const float* first = &stencil->value[DistanceStencil::index(3, 4, -1)];
  VoxelRow row;
  findSlopes<lanes>(level, first, kTolerance, row);
  findOctants<lanes>(level, first, kMostResidual, row);
  // Beyond the stencil's points a row has values of the next one, which no voxel looks at.
  for (int lane = 0; lane < std::min(lanes, kBlockPoints + 2); ++lane) {
    const float* p = first + lane;
    std::array<bool, 3> jumps;
    for (int axis = 0; axis < 3; ++axis) {
      const int step = DistanceStencil::kStep[axis];
      const OneSidedSlopes s(p, step);
      jumps[axis] = !(std::abs(s.above - s.below) <= kTolerance);
      const float below = row.slope[2 * axis * kLanes + lane], above = row.slope[(2 * axis + 1) * kLanes + lane];
      if (jumps[axis]) {
        ASSERT_TRUE(below == s.below || std::isnan(s.below));
        ASSERT_TRUE(above == s.above || std::isnan(s.above));
      } else {
        ASSERT_EQ(below, 0.5F * (p[step] - p[-step]));
        ASSERT_EQ(above, below);
      }
      ASSERT_EQ(row.jump[axis][lane], jumps[axis] ? kInfinity : 0);
      counts.jumps += jumps[axis];
    }
    const Octants expected(p, jumps);
    for (int o = 0; o < kOctants; ++o) {
      ASSERT_EQ((row.octants[lane] >> o & 1) != 0, expected.accepted[o]) << lane << ' ' << o;
      if (expected.accepted[o]) {
        ASSERT_EQ(row.residual[o * kLanes + lane], expected.residual[o]) << lane << ' ' << o;
      }
      counts.accepted += expected.accepted[o];
      counts.rejected += expected.residual[o] < kInfinity && !expected.accepted[o];
    }
  }
}

TEST(VoxelRow, OctantsAreThoseThatAPlainLoopFinds) {
  Counts counts;
  for (unsigned seed = 0; seed < 20; ++seed)
    for (const SimdLevel level : test::simdLevels()) {
      SCOPED_TRACE(seed);
      expectPlainSlopesAndOctants<kLanes>(seed, level, counts);
      expectPlainSlopesAndOctants<kLanes / 2>(seed, level, counts);
    }
  EXPECT_GT(counts.accepted, 1000);
  EXPECT_GT(counts.rejected, 100);
  EXPECT_GT(counts.jumps, 100);
}

}  // namespace
}  // namespace pdc::detail
