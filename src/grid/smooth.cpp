#include "pdc/grid/smooth.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Filter.h>
#include <openvdb/tools/LevelSetFilter.h>
#include <openvdb/tools/Morphology.h>

#include <cmath>
#include <stdexcept>

#include "grid/level_set.h"
#include "grid/monitor_interrupter.h"
#include "grid/real_grid.h"
#include "pdc/error.h"

namespace pdc {
namespace {

/// How often OpenVDB's level set filters call start(): to rebuild the band after a pass, and once for the filter.
constexpr int kStartsOfBand = 4;

/// OpenVDB's gaussian filter is so many means.
constexpr int kGaussianPasses = 4;

/// \throws Error for radii that are no number of voxels within the limits.
int widthInVoxels(const SmoothGridOptions& options, const openvdb::Vec3d& voxel) {
  const double width = options.radius / voxel.x();
  const int most = options.filter == SmoothFilter::kMedian      ? kMostMedianVoxels
                   : options.filter == SmoothFilter::kCurvature ? kMostFlowVoxels
                                                                : kMostSmoothVoxels;
  if (width < 0.5)
    throw Error(fmt::format("smoothing with radius {:.6g} changes nothing; at least half a voxel, {:.6g}",
                            options.radius, voxel.x() / 2));
  if (width > most)
    throw Error(
        fmt::format("smoothing with radius {:.6g} takes too long; at most {} voxels, {:.6g}, of this filter; "
                    "larger voxels (--resample) allow more",
                    options.radius, most, most * voxel.x()));
  return static_cast<int>(std::lround(width));
}

/// The number of steps after which OpenVDB's flow has shrunk a ball of a radius, in voxels, to nothing: r² falls by 2
/// per unit of time, as its mean curvature is 1 / r, and a step is 1/3.
int flowSteps(double radius) { return std::max(1, static_cast<int>(std::lround(1.5 * radius * radius))); }

template <typename GridT>
void smoothLevelSet(GridT& grid, const SmoothGridOptions& options, const Monitor& monitor) {
  using Filter = openvdb::tools::LevelSetFilter<GridT>;
  const int width = widthInVoxels(options, grid.voxelSize());
  const bool flow = options.filter == SmoothFilter::kCurvature;
  const int passes = flow                                        ? flowSteps(options.radius / grid.voxelSize()[0])
                     : options.filter == SmoothFilter::kGaussian ? kGaussianPasses
                                                                 : 1;
  detail::MonitorInterrupter interrupter(monitor, "smoothing",
                                         passes * (kStartsOfBand + (flow ? 1 : 0)) + (flow ? 0 : 1));
  Filter filter(grid, &interrupter);
  switch (options.filter) {
    case SmoothFilter::kMean:
      return filter.mean(width);
    case SmoothFilter::kGaussian:
      return filter.gaussian(width);
    case SmoothFilter::kMedian:
      return filter.median(width);
    case SmoothFilter::kCurvature:
      for (int i = 0; i < passes && !grid.empty(); ++i) filter.meanCurvature();
  }
}

/// Refuses tiles whose borders alone, which become voxels, would take all memory.
template <typename GridT>
void checkTiles(const GridT& grid, int reach) {
  double voxels = 0;
  auto tile = grid.cbeginValueOn();
  tile.setMaxDepth(decltype(tile)::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    const double dim = tile.getBoundingBox().dim().x();
    voxels += 6 * dim * dim * (2 * reach + GridT::TreeType::LeafNodeType::DIM);
  }
  // Tiles of leaves lie beside each other mostly, and then have no border.
  constexpr double kBytes = sizeof(typename GridT::ValueType) / 4.0;
  detail::checkVoxels(voxels, kBytes);
}

template <typename GridT>
void smoothFog(GridT& grid, const SmoothGridOptions& options, const Monitor& monitor) {
  const int width = widthInVoxels(options, grid.voxelSize());
  const int reach = width * (options.filter == SmoothFilter::kGaussian ? kGaussianPasses : 1);
  checkTiles(grid, reach);
  // Where values end beside the background, the filters would leave a step: they change active values only.
  openvdb::tools::dilateActiveValues(grid.tree(), reach, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                     openvdb::tools::PRESERVE_TILES);
  detail::MonitorInterrupter interrupter(monitor, "smoothing", 1);
  openvdb::tools::Filter<GridT> filter(grid, &interrupter);
  filter.setProcessTiles(true);
  switch (options.filter) {
    case SmoothFilter::kMean:
      return filter.mean(width);
    case SmoothFilter::kGaussian:
      return filter.gaussian(width);
    case SmoothFilter::kMedian:
      return filter.median(width);
    case SmoothFilter::kCurvature:
      throw Error("smoothing by curvature needs a level set, and the grid is a fog volume");
  }
}

}  // namespace

void smoothGrid(GridVolume& volume, const SmoothGridOptions& options, GridStepReport* report, const Monitor& monitor) {
  if (!std::isfinite(options.radius) || !(options.radius > 0))
    throw std::invalid_argument("smoothGrid: the radius must be finite and above 0");
  monitor.throwIfStopped();
  detail::StepRecord record(volume, report);
  const bool levelSet = volume.gridClass == GridClass::kLevelSet;
  if (levelSet) {
    detail::ensureDistances(volume, "smoothing", record, monitor);
  } else if (!volume.grid->hasUniformVoxels()) {
    const openvdb::Vec3d size = volume.grid->voxelSize();
    throw Error(
        fmt::format("smoothing needs voxels that are cubes, and these are {:.6g} x {:.6g} x {:.6g}; --resample "
                    "makes them so",
                    size.x(), size.y(), size.z()));
  }
  detail::visitReal(volume, "smoothGrid", [&](auto& grid) {
    if (grid.empty()) return;
    if (levelSet) {
      smoothLevelSet(grid, options, monitor);
    } else {
      smoothFog(grid, options, monitor);
    }
  });
  record.finish(volume);
}

}  // namespace pdc
