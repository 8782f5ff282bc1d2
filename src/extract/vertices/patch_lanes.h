#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "extract/vertices/patch_sums.h"
#include "extract/vertices/sigma_normal.h"
#include "math/lane_loops.h"
#include "pdc/math/quadric_lanes.h"

namespace pdc::detail {

/// Sixteen patches while their vertices are solved, one per lane; those beyond a block's last repeat it. The functions
/// must be compiled into a function of a SimdLevel.
struct PatchLanes {
  alignas(64) std::uint32_t cell[kLanes];
  NormalEquationsLanes<float> system;  ///< About the mass points.
  SolutionLanes<float> step;
  Vec3Lanes<float> mass;                            ///< The mass points, from the low corner of the cell.
  alignas(64) float excess[kLanes], noise[kLanes];  ///< See PatchSpread; only where σn is of patches.
  alignas(64) float residual[kLanes];               ///< See chordResidual(); 0 where it is not needed.
  alignas(64) float variance[kLanes];               ///< The factor on Sigma_n.
  alignas(64) float reach[kLanes];
  alignas(64) float placed[12][kLanes];  ///< The members of PlacedQuadric, in order.
  alignas(64) float position[4][kLanes];

  /// Fills cells, systems and mass points. About its mass point a patch's right-hand side is small where the surface is
  /// flat, and so is what rounding does to the solution; and the noise of the normals adds to A alone (see
  /// normalNoiseQuadric()).
  void setUp(std::span<const SurfacePatch> patches, const PatchSumLanes& sum, const SymMat3<float>& Sigma_n) {
    const SymMat3<float> S = Sigma_n;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      cell[lane] = patches[std::min(lane, patches.size() - 1)].cell.number;
    forEachLane([&](int i) {
      const float n = sum.weight(i);
      const Vec3f massPoint = sum.place(i) * (1.0F / n);
      const SymMat3<float> A = sum.A(i);
      mass.set(i, massPoint);
      system.b.set(i, sum.b(i) - A * massPoint);
      system.A.set(i, A + S * (n * variance[i]));
    });
  }

  /// Fills the spreads. \param spreadOf of a patch, from its Σrrᵀ and its weight.
  template <typename SpreadOf>
  void measure(const PatchSumLanes& sum, const SpreadOf& spreadOf) {
    forEachLane([&](int i) {
      const PatchSpread<float> s = spreadOf(sum.A(i), sum.weight(i));
      excess[i] = s.excess;
      noise[i] = s.noise;
      residual[i] = 0;
    });
  }

  /// Fills the variances from spreads and residuals.
  void chooseSigma(const SigmaNormal& sigma) {
    forEachLane([this, sigma](int i) {
      variance[i] = sigma.variance(PatchSpread<float>{excess[i], noise[i]}, residual[i]);
    });
  }

  /// Fills reach and quadrics from the solved steps. Vertices not farther out than `snapped` are put within `inCell`.
  void place(float inCell, float snapped) {
    forEachLane([&](int i) {
      const Vec3f v = mass.get(i) - Vec3f{0.5F, 0.5F, 0.5F} + step.x.get(i);
      const SymMat3<float> A = system.A.get(i);
      const Vec3f b = A * v;
      const float ax = std::abs(v.x), ay = std::abs(v.y), az = std::abs(v.z), xy = ax > ay ? ax : ay;
      const float farthest = xy > az ? xy : az;
      const float bound = farthest <= snapped ? inCell : std::numeric_limits<float>::max();
      const auto clamped = [bound](float c) { return c > bound ? bound : c < -bound ? -bound : c; };
      reach[i] = farthest;
      const float e[12] = {clamped(v.x), clamped(v.y), clamped(v.z), A.xx, A.xy, A.xz, A.yy, A.yz, A.zz, b.x, b.y, b.z};
      for (int k = 0; k < 12; ++k) placed[k][i] = e[k];
    });
  }

  /// Fills world positions from the quadrics. \param linear of an affine map; \param base where it puts the block's
  /// origin.
  void toWorld(const Mat3d& linear, const Vec3d& base) {
    forEachLane([&](int i) {
      const auto from = [](std::uint32_t low, float x) { return double(static_cast<float>(low) + 0.5F) + double(x); };
      const std::uint32_t c = cell[i];
      const Vec3d inBlock{from(c >> 6, placed[0][i]), from(c >> 3 & 7, placed[1][i]), from(c & 7, placed[2][i])};
      const Vec3d p = linear * inBlock + base;
      position[0][i] = static_cast<float>(p.x);
      position[1][i] = static_cast<float>(p.y);
      position[2][i] = static_cast<float>(p.z);
    });
  }
};

}  // namespace pdc::detail
