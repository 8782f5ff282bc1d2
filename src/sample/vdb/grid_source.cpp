#include "pdc/sample/vdb/grid_source.h"

#include <openvdb/openvdb.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "sample/creases/distance_planes.h"
#include "sample/creases/distance_probe.h"
#include "sample/meaning/grid_map.h"
#include "sample/vdb/grid_sampler.h"
#include "sample/vdb/noise_grids.h"

namespace pdc {
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

/// \returns nothing where planes must be taken from crossings.
std::optional<detail::DistanceModel> chooseDistanceModel(HermiteMode mode, bool mayBeDistance,
                                                         const detail::GridSampler& sampler, const LatticeMap& map) {
  const bool asked = mode == HermiteMode::kDistance;
  if (asked && !map.affine()) throw Error("the distance estimator needs an affine transform");
  if (mode == HermiteMode::kGradient || !map.affine() || !(asked || mayBeDistance)) return std::nullopt;
  const Mat3d M = map.jacobian({}) * (1 / map.voxelSize());
  const auto inVoxels = static_cast<float>(1 / map.voxelSize());
  const detail::DistanceProbe probe = detail::probeDistances(
      sampler.someLeaves(detail::kProbeBlocks), inverse(M),
      [&](const Coord& block, detail::DistanceStencil& stencil) { sampler.readDistances(block, inVoxels, stencil); });
  if (!asked && !(probe.slopeError <= kSlopeError && probe.texture <= kMostTexture)) return std::nullopt;
  return detail::DistanceModel{.M = M, .noise = probe.noise, .texture = asked ? 0 : probe.texture};
}

}  // namespace

struct GridSource::Impl {
  detail::GridReading reading;
  LatticeMap map;
  GridMeaning meaning;
  std::unique_ptr<const detail::GridSampler> sampler;
  std::optional<detail::DistanceModel> distances;  ///< Nothing where planes are taken from crossings.
  detail::NoiseGrids noise;
};

GridSource::GridSource(const openvdb::GridBase::ConstPtr& grid, const GridSourceOptions& options) {
  if (!grid) throw std::invalid_argument("GridSource: the grid is null");
  if (options.iso && !std::isfinite(*options.iso)) throw Error("the isovalue must be finite");
  ReadableGrid readable = readMeaning(grid, {.iso = options.iso,
                                             .gridClass = options.gridClass,
                                             .inside = options.inside,
                                             .weight = options.weight,
                                             .floodFill = options.floodFill});
  GridMeaning& meaning = readable.meaning;
  // What lies beyond the active values does not matter there.
  if (options.open)
    std::erase_if(meaning.doubts,
                  [](GridDoubt d) { return d == GridDoubt::kNotFloodFilled || d == GridDoubt::kCutAtEnd; });
  const detail::GridReading reading{.iso = meaning.iso,
                                    .insideIsHigher = meaning.inside == InsideValues::kHigh,
                                    .open = options.open,
                                    .acceptNonFinite = options.acceptNonFinite,
                                    .clamp = readable.clamp};
  auto sampler = detail::makeGridSampler(readable.grid, reading);
  LatticeMap map = detail::gridMap(*grid);
  const bool real = grid->isType<openvdb::FloatGrid>() || grid->isType<openvdb::DoubleGrid>();
  const bool mayBeDistance = real && meaning.gridClass == GridClass::kLevelSet;
  std::optional<detail::DistanceModel> distances = chooseDistanceModel(options.hermite, mayBeDistance, *sampler, map);
  mImpl = std::make_unique<Impl>(Impl{reading, std::move(map), std::move(meaning), std::move(sampler), distances,
                                      detail::NoiseGrids(grid, options)});
}

GridSource::~GridSource() = default;

SurfaceBlocks GridSource::surfaceBlocks(const Monitor& monitor) const {
  return mImpl->sampler->surfaceBlocks(monitor, mImpl->noise.weight()).blocks;
}

std::optional<SurfaceForecast> GridSource::forecast(const Monitor& monitor) const {
  return mImpl->sampler->forecast(monitor);
}

const LatticeMap& GridSource::map() const { return mImpl->map; }

SourceKnowledge GridSource::knowledge() const {
  using Noise = SourceKnowledge::Noise;
  const detail::NoiseGrids& noise = mImpl->noise;
  return {.exactNormals = false,
          .allCreases = usesDistances(),
          .noise = noise.hasSigma() ? Noise::kSigma
                   : noise.any()    ? Noise::kWeights
                                    : Noise::kNone};
}

void GridSource::fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const {
  mImpl->sampler->fillHermite(block, mImpl->map, hermite);
}

void GridSource::fillNoise(const SurfaceBlock& block, const HermiteBlock& hermite, PlaneNoise& noise) const {
  mImpl->noise.fill(block.coord, block.edges, hermite, *mImpl->sampler, noise);
}

void GridSource::fillFeaturePlanes(const SurfaceBlock& block, const HermiteBlock& hermite,
                                   std::span<const SurfacePatch> patches, FeaturePlanes& planes) const {
  if (!mImpl->distances) return;
  const auto read = [&](detail::DistanceStencil& stencil) {
    mImpl->sampler->readDistances(block.coord, static_cast<float>(1 / mImpl->map.voxelSize()), stencil);
  };
  detail::DistanceModel model = *mImpl->distances;
  if (mImpl->noise.hasSigma()) {
    model.noise = kBeyond * mImpl->noise.largestSigma(block.coord, block.edges, hermite) / mImpl->map.voxelSize();
    if (model.noise > kMostNoise) return;
  }
  detail::findFeaturePlanes({block.signs, block.edges, hermite, patches}, model, read, planes);
}

void GridSource::prefetch(const Coord& block) const { mImpl->sampler->prefetch(block); }

double GridSource::iso() const { return mImpl->reading.iso; }
bool GridSource::usesDistances() const { return mImpl->distances.has_value(); }
double GridSource::valueNoise() const { return mImpl->distances ? mImpl->distances->noise : 0; }
std::size_t GridSource::refusedNoise() const { return mImpl->noise.refused(); }
std::size_t GridSource::crossingsWithoutData() const {
  if (mImpl->reading.open || mImpl->noise.weight() == nullptr) return 0;
  return mImpl->sampler->surfaceBlocks({}, mImpl->noise.weight()).crossingsWithoutData;
}
bool GridSource::insideIsHigher() const { return mImpl->reading.insideIsHigher; }
const GridMeaning& GridSource::meaning() const { return mImpl->meaning; }

}  // namespace pdc
