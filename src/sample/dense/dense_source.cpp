#include "pdc/sample/dense/dense_source.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "pdc/error.h"
#include "sample/dense/border_caps.h"
#include "sample/dense/check_volume.h"
#include "sample/dense/volume_blocks.h"
#include "sample/dense/volume_meaning.h"
#include "sample/dense/volume_reader.h"
#include "sample/dense/volume_scan.h"
#include "sample/stencils/block_hermite.h"
#include "sample/stencils/known_distances.h"
#include "sample/stencils/value_noise.h"

namespace pdc {
namespace {

constexpr double kNoClamp = std::numeric_limits<double>::infinity();

using detail::VolumeReader;
using detail::VolumeSigns;

void check(const VolumeView& values, const DenseSourceOptions& options) {
  detail::checkVolume(values, "the volume");
  if (options.iso && !std::isfinite(*options.iso))
    throw Error(fmt::format("the isovalue must be finite, not {}", *options.iso));
  const auto checkCompanion = [&](const std::optional<VolumeView>& view, const char* what) {
    if (!view) return;
    detail::checkVolume(*view, what);
    if (view->size != values.size)
      throw Error(fmt::format("{} has {}×{}×{} points, the volume {}×{}×{}", what, view->size[0], view->size[1],
                              view->size[2], values.size[0], values.size[1], values.size[2]));
  };
  checkCompanion(options.sigma, "the sigma volume");
  checkCompanion(options.weight, "the weight volume");
  checkCompanion(options.mask, "the mask");
}

}  // namespace

struct DenseSource::Impl {
  std::shared_ptr<const void> owner;
  LatticeMap map;
  std::optional<VolumeView> maskView, weightView;
  std::unique_ptr<const VolumeSigns> mask;
  GridMeaning meaning;
  detail::ValueReading reading;
  std::unique_ptr<const VolumeReader> values, sigma, weight;
  std::optional<detail::DistanceModel> distances;  ///< Nothing where planes are taken from crossings.
  std::size_t refused = 0;

  explicit Impl(const LatticeMap& m) : map(m) {}

  [[nodiscard]] detail::ValueNoise noise() const { return {sigma.get(), weight.get()}; }
  [[nodiscard]] detail::BorderCaps caps() const { return {values->sampler().view().size, mask.get(), map}; }
  [[nodiscard]] bool hasCaps(const Coord& block) const { return !reading.open && caps().mayTouch(block); }
  std::unique_ptr<const VolumeReader> readerOf(const std::optional<VolumeView>& view) {
    if (!view) return nullptr;
    refused += detail::countRefused(*view);
    return std::make_unique<VolumeReader>(*view, detail::ValueReading{.clamp = kNoClamp}, nullptr);
  }
};

DenseSource::DenseSource(const VolumeView& values, const LatticeMap& map, const DenseSourceOptions& options,
                         std::shared_ptr<const void> owner) {
  check(values, options);
  auto impl = std::make_unique<Impl>(map);
  impl->owner = std::move(owner);
  impl->maskView = options.mask;
  impl->weightView = options.weight;
  if (options.mask)
    impl->mask = std::make_unique<VolumeSigns>(*detail::makeMaskSampler(*options.mask), nullptr, Monitor{});
  const VolumeReader plain(values, {.clamp = kNoClamp}, impl->mask.get());
  detail::VolumeMeaning read = detail::readVolumeMeaning(plain, impl->mask.get(), map, options);
  impl->meaning = std::move(read.meaning);
  if (options.open) std::erase(impl->meaning.doubts, GridDoubt::kCutAtEnd);
  impl->reading = {.iso = impl->meaning.iso,
                   .insideIsHigher = impl->meaning.inside == InsideValues::kHigh,
                   .open = options.open,
                   .acceptNonFinite = options.acceptNonFinite,
                   .clamp = read.clamp};
  impl->values = std::make_unique<VolumeReader>(values, impl->reading, impl->mask.get());
  impl->sigma = impl->readerOf(options.sigma);
  impl->weight = impl->readerOf(options.weight);
  const bool real = values.type == ScalarType::kFloat32 || values.type == ScalarType::kFloat64;
  impl->distances = detail::chooseDistanceModel(
      options.hermite, real && impl->meaning.gridClass == GridClass::kLevelSet,
      [&](std::size_t most) { return impl->values->someBlocks(most); }, *impl->values, map);
  mImpl = std::move(impl);
}

DenseSource::~DenseSource() = default;

SurfaceBlocks DenseSource::surfaceBlocks(const Monitor& monitor) const {
  monitor.throwIfStopped();
  const detail::VolumeSampler& values = mImpl->values->sampler();
  const VolumeSigns* mask = mImpl->mask.get();
  VolumeSigns signs(values, mask, monitor);
  if (!mImpl->reading.acceptNonFinite && !signs.allFinite())
    detail::requireFiniteValues(values, mImpl->maskView ? &*mImpl->maskView : nullptr);
  signs.addPointsBetween(values, mask);
  if (!mImpl->reading.open) return detail::findVolumeBlocks(signs, nullptr, monitor);
  std::unique_ptr<const VolumeSigns> weight;
  if (mImpl->weightView)
    weight = std::make_unique<VolumeSigns>(*detail::makeVolumeSampler(*mImpl->weightView, {.insideIsHigher = true}),
                                           nullptr, monitor);
  const detail::VolumeData data{values.view().size, mask, weight.get()};
  return detail::findVolumeBlocks(signs, &data, monitor);
}

std::optional<SurfaceForecast> DenseSource::forecast(const Monitor& monitor) const {
  return detail::forecastVolumeBlocks(mImpl->values->sampler(), monitor);
}

const LatticeMap& DenseSource::map() const { return mImpl->map; }

SourceKnowledge DenseSource::knowledge() const {
  return {.exactNormals = false, .allCreases = usesDistances(), .noise = mImpl->noise().knowledge()};
}

void DenseSource::fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const {
  detail::GradientStencil stencil;
  mImpl->values->readGradients(block.coord, block.edges, stencil);
  detail::fillBlockHermite(stencil, block, mImpl->values->limits(), mImpl->map, hermite);
  if (mImpl->hasCaps(block.coord)) mImpl->caps().place(block, hermite);
}

void DenseSource::fillNoise(const SurfaceBlock& block, const HermiteBlock& hermite, PlaneNoise& noise) const {
  mImpl->noise().fill(block.coord, block.edges, hermite, *mImpl->values, noise);
  if (mImpl->hasCaps(block.coord)) mImpl->caps().clearNoise(block, mImpl->weight != nullptr, noise);
}

void DenseSource::fillFeaturePlanes(const SurfaceBlock& block, const HermiteBlock& hermite,
                                    std::span<const SurfacePatch> patches, FeaturePlanes& planes) const {
  std::optional<detail::DistanceModel> model = mImpl->distances;
  if (const detail::ValueNoise noise = mImpl->noise(); model && noise.sigma != nullptr)
    model = detail::withNoise(*model, noise.largestSigma(block.coord, block.edges, hermite), mImpl->map);
  if (model) {
    const auto read = [&](detail::DistanceStencil& stencil) {
      mImpl->values->readDistances(block.coord, static_cast<float>(1 / mImpl->map.voxelSize()), stencil);
    };
    detail::findFeaturePlanes({block.signs, block.edges, hermite, patches}, *model, read, planes);
  }
  if (mImpl->hasCaps(block.coord)) mImpl->caps().addPlanes(block, hermite, patches, planes);
}

void DenseSource::prefetch(const Coord& block) const { mImpl->values->prefetch(block); }

double DenseSource::iso() const { return mImpl->reading.iso; }
bool DenseSource::insideIsHigher() const { return mImpl->reading.insideIsHigher; }
const GridMeaning& DenseSource::meaning() const { return mImpl->meaning; }
bool DenseSource::usesDistances() const { return mImpl->distances.has_value(); }
double DenseSource::valueNoise() const { return mImpl->distances ? mImpl->distances->noise : 0; }
std::size_t DenseSource::refusedNoise() const { return mImpl->refused; }

}  // namespace pdc
