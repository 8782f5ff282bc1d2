#include "sample/stencils/known_distances.h"

#include "pdc/error.h"
#include "sample/creases/distance_probe.h"

namespace pdc::detail {
namespace {

/// A median slope this far from one belongs to something else than a distance: exact distances have at most 0.001, with
/// noise of 0.1 voxel 0.05 to 0.07.
constexpr double kSlopeError = 0.15;

/// Where surfaces have more texture than this, in voxels, facets look like creases. Level sets of organic meshes whose
/// facets are as large as a voxel have 0.006 to 0.01, of solids at most 0.001.
constexpr double kMostTexture = 0.005;

/// Where values are known to have more noise than this, in voxels, one-sided slopes see creases everywhere.
constexpr double kMostNoise = 0.3;

/// Planes of a block come from samples beyond it too, whose noise is larger where it grows. Without this factor, where
/// noise grows by 0.004 voxel per voxel, edges were 1 to 2 % less exact.
constexpr double kBeyond = 1.15;

}  // namespace

std::optional<DistanceModel> chooseDistanceModel(HermiteMode mode, bool mayBeDistance,
                                                 const std::function<std::vector<Coord>(std::size_t)>& someBlocks,
                                                 const DistanceReader& values, const LatticeMap& map) {
  const bool asked = mode == HermiteMode::kDistance;
  if (asked && !map.affine()) throw Error("the distance estimator needs an affine transform");
  if (mode == HermiteMode::kGradient || !map.affine() || !(asked || mayBeDistance)) return std::nullopt;
  const Mat3d M = map.jacobian({}) * (1 / map.voxelSize());
  const auto inVoxels = static_cast<float>(1 / map.voxelSize());
  const DistanceProbe probe = probeDistances(
      someBlocks(kProbeBlocks), inverse(M),
      [&](const Coord& block, DistanceStencil& stencil) { values.readDistances(block, inVoxels, stencil); });
  if (!asked && !(probe.slopeError <= kSlopeError && probe.texture <= kMostTexture)) return std::nullopt;
  return DistanceModel{.M = M, .noise = probe.noise, .texture = asked ? 0 : probe.texture};
}

std::optional<DistanceModel> withNoise(DistanceModel model, double sigma, const LatticeMap& map) {
  model.noise = kBeyond * sigma / map.voxelSize();
  if (model.noise > kMostNoise) return std::nullopt;
  return model;
}

}  // namespace pdc::detail
