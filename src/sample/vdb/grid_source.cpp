#include "pdc/sample/vdb/grid_source.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "sample/creases/distance_planes.h"
#include "sample/creases/distance_probe.h"
#include "sample/vdb/contourable_grids.h"
#include "sample/vdb/grid_sampler.h"
#include "sample/vdb/noise_grids.h"

namespace pdc {
namespace {

/// Isovalue of fog volumes and other densities where none is asked for, as in Houdini's converter.
constexpr double kDensityIso = 0.5;

double background(const openvdb::GridBase& grid) {
  double value = 0;
  detail::visitContourable(grid, [&](const auto& typed) { value = static_cast<double>(typed.background()); });
  return value;
}

/// The centre of what is active, in lattice units; the origin if nothing is.
Vec3d centerOfData(const openvdb::GridBase& grid) {
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) return {};
  Vec3d center;
  for (int i = 0; i < 3; ++i) center[i] = 0.5 * (static_cast<double>(box.min()[i]) + static_cast<double>(box.max()[i]));
  return center;
}

LatticeMap makeMap(const openvdb::GridBase& grid) {
  const openvdb::math::Transform& transform = grid.transform();
  if (transform.isLinear()) {
    // OpenVDB multiplies row vectors from the left.
    const openvdb::Mat4d m = transform.baseMap()->getAffineMap()->getMat4();
    Mat3d linear;
    for (int i = 0; i < 3; ++i) linear.row[i] = {m(0, i), m(1, i), m(2, i)};
    return LatticeMap(linear, {m(3, 0), m(3, 1), m(3, 2)});
  }
  const auto toVdb = [](const Vec3d& v) { return openvdb::Vec3d(v.x, v.y, v.z); };
  const auto map = transform.baseMap();
  const auto position = [map, toVdb](const Vec3d& x) {
    const openvdb::Vec3d p = map->applyMap(toVdb(x));
    return Vec3d{p.x(), p.y(), p.z()};
  };
  const auto jacobian = [map, toVdb](const Vec3d& x) {
    Mat3d columns;
    for (int i = 0; i < 3; ++i) {
      openvdb::Vec3d axis(0);
      axis[i] = 1;
      const openvdb::Vec3d c = map->applyJacobian(axis, toVdb(x));
      columns.row[i] = {c.x(), c.y(), c.z()};
    }
    return columns.transposed();
  };
  // The origin may lie outside of a frustum, or at its apex.
  return LatticeMap(position, jacobian, centerOfData(grid));
}

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
  std::unique_ptr<const detail::GridSampler> sampler;
  std::optional<detail::DistanceModel> distances;  ///< Nothing where planes are taken from crossings.
  detail::NoiseGrids noise;
};

GridSource::GridSource(const openvdb::GridBase::ConstPtr& grid, const GridSourceOptions& options) {
  if (!grid) throw std::invalid_argument("GridSource: the grid is null");
  if (options.iso && !std::isfinite(*options.iso)) throw Error("the isovalue must be finite");
  const openvdb::GridClass gridClass = grid->getGridClass();
  const double outside = background(*grid);

  // An unclassified grid about a positive background is a level set by another name; a mask is true inside.
  const bool classified = gridClass == openvdb::GRID_LEVEL_SET || gridClass == openvdb::GRID_FOG_VOLUME;
  const bool mask = grid->isType<openvdb::BoolGrid>();
  const bool distance = !mask && (classified ? gridClass == openvdb::GRID_LEVEL_SET : outside > 0);
  detail::GridReading reading;
  reading.iso = options.iso.value_or(distance ? 0.0 : kDensityIso);
  reading.insideIsHigher =
      classified || mask ? !distance : outside < reading.iso || (outside == reading.iso && !distance);
  reading.open = options.open;
  reading.acceptNonFinite = options.acceptNonFinite;
  reading.clamp = distance ? std::abs(outside) : std::numeric_limits<double>::infinity();

  auto sampler = detail::makeGridSampler(grid, reading);
  if (!sampler)
    throw Error(
        fmt::format("grid of type {} cannot be contoured; {} can", grid->valueType(), detail::contourableTypeNames()));
  LatticeMap map = makeMap(*grid);
  const bool mayBeDistance = distance && (grid->isType<openvdb::FloatGrid>() || grid->isType<openvdb::DoubleGrid>());
  std::optional<detail::DistanceModel> distances = chooseDistanceModel(options.hermite, mayBeDistance, *sampler, map);
  mImpl = std::make_unique<Impl>(
      Impl{reading, std::move(map), std::move(sampler), distances, detail::NoiseGrids(grid, options)});
}

GridSource::~GridSource() = default;

SurfaceBlocks GridSource::surfaceBlocks(const Monitor& monitor) const { return mImpl->sampler->surfaceBlocks(monitor); }

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
bool GridSource::insideIsHigher() const { return mImpl->reading.insideIsHigher; }

}  // namespace pdc
