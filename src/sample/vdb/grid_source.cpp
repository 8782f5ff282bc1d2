#include "pdc/sample/vdb/grid_source.h"

#include <openvdb/openvdb.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "sample/meaning/grid_map.h"
#include "sample/stencils/known_distances.h"
#include "sample/vdb/grid_sampler.h"
#include "sample/vdb/noise_grids.h"

namespace pdc {

struct GridSource::Impl {
  detail::ValueReading reading;
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
  const detail::ValueReading reading{.iso = meaning.iso,
                                     .insideIsHigher = meaning.inside == InsideValues::kHigh,
                                     .open = options.open,
                                     .acceptNonFinite = options.acceptNonFinite,
                                     .clamp = readable.clamp};
  auto sampler = detail::makeGridSampler(readable.grid, reading);
  LatticeMap map = detail::gridMap(*grid);
  const bool real = grid->isType<openvdb::FloatGrid>() || grid->isType<openvdb::DoubleGrid>();
  const bool mayBeDistance = real && meaning.gridClass == GridClass::kLevelSet;
  std::optional<detail::DistanceModel> distances = detail::chooseDistanceModel(
      options.hermite, mayBeDistance, [&](std::size_t most) { return sampler->someLeaves(most); }, *sampler, map);
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
  return {.exactNormals = false, .allCreases = usesDistances(), .noise = mImpl->noise.noise().knowledge()};
}

void GridSource::fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const {
  mImpl->sampler->fillHermite(block, mImpl->map, hermite);
}

void GridSource::fillNoise(const SurfaceBlock& block, const HermiteBlock& hermite, PlaneNoise& noise) const {
  mImpl->noise.noise().fill(block.coord, block.edges, hermite, *mImpl->sampler, noise);
}

void GridSource::fillFeaturePlanes(const SurfaceBlock& block, const HermiteBlock& hermite,
                                   std::span<const SurfacePatch> patches, FeaturePlanes& planes) const {
  if (!mImpl->distances) return;
  const auto read = [&](detail::DistanceStencil& stencil) {
    mImpl->sampler->readDistances(block.coord, static_cast<float>(1 / mImpl->map.voxelSize()), stencil);
  };
  std::optional<detail::DistanceModel> model = mImpl->distances;
  if (const detail::ValueNoise noise = mImpl->noise.noise(); noise.sigma != nullptr)
    model = detail::withNoise(*model, noise.largestSigma(block.coord, block.edges, hermite), mImpl->map);
  if (model) detail::findFeaturePlanes({block.signs, block.edges, hermite, patches}, *model, read, planes);
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
