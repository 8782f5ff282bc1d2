#include "grid/level_set.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>

#include "extract/contour_memory.h"
#include "parallel/machine_memory.h"
#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/extract/contour_forecast.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc::detail {
namespace {

/// Coordinates of a lattice stay well within 32 bits, stencils included.
constexpr double kFarthest = 1 << 30;

double volumeOf(const openvdb::Vec3d& v) { return std::abs(v.x() * v.y() * v.z()); }

using SampledGrids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::BoolGrid>;

openvdb::Vec3d cornerOf(const openvdb::CoordBBox& box, int corner) {
  openvdb::Vec3d p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = ((corner >> axis & 1) != 0 ? box.max() : box.min())[axis];
  return p;
}

/// By how much the voxels of a box become more on another lattice, at least 1. Lattices of a frustum grow differently
/// from place to place, and OpenVDB samples the whole box about what becomes of a leaf or a tile.
double growthOf(const openvdb::math::Transform& from, const openvdb::math::Transform& to,
                const openvdb::CoordBBox& box) {
  if (from.isLinear() && to.isLinear()) return std::max(1.0, volumeOf(from.voxelSize()) / volumeOf(to.voxelSize()));
  openvdb::BBoxd reached;
  for (int corner = 0; corner < 8; ++corner) reached.expand(to.worldToIndex(from.indexToWorld(cornerOf(box, corner))));
  return std::max(1.0, volumeOf(reached.extents()) / static_cast<double>(box.volume()));
}

/// What OpenVDB samples of a grid: active values, and inactive tiles of values other than the background.
struct Sampled {
  openvdb::CoordBBox box;
  double voxels = 0;  ///< On the other lattice.
};

template <typename GridT>
Sampled sampledOf(const GridT& grid, const openvdb::math::Transform& target) {
  Sampled sampled{.box = grid.evalActiveVoxelBoundingBox()};
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf)
    sampled.voxels +=
        static_cast<double>(leaf->onVoxelCount()) * growthOf(grid.transform(), target, leaf->getNodeBoundingBox());
  auto tile = grid.cbeginValueAll();
  tile.setMaxDepth(decltype(tile)::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    if (!tile.isValueOn() && openvdb::math::isApproxEqual(*tile, grid.background())) continue;
    const openvdb::CoordBBox box = tile.getBoundingBox();
    sampled.box.expand(box);
    sampled.voxels += static_cast<double>(box.volume()) * growthOf(grid.transform(), target, box);
  }
  return sampled;
}

/// Refuses a contour, and a level set of it, that would take all memory, before either is made.
void checkContour(const GridSource& source, const ContourOptions& options, const openvdb::math::Transform& transform,
                  double halfWidth, const Monitor& monitor) {
  const auto forecast = forecastContour(source, options, monitor);
  if (!forecast) return;
  checkMemory(forecast->memory, forecast->vertices, options);
  const double scale = source.map().voxelSize() / transform.voxelSize()[0];
  checkVoxels(forecast->vertices * scale * scale * 2 * halfWidth, kBandBytes);
}

/// A volume's contour, of which a level set is made.
Mesh contourFor(const GridVolume& volume, const openvdb::math::Transform& transform, double halfWidth,
                const Monitor& monitor) {
  const GridSource source(volume.grid, {.iso = volume.iso, .gridClass = volume.gridClass, .inside = volume.inside});
  // Faces that intersect by a little do no harm to distances, and proving that none do takes time.
  const ContourOptions options{.placement = Placement::kFree, .origin = std::nullopt};
  checkContour(source, options, transform, halfWidth, monitor);
  Mesh mesh = contour(source, options, nullptr, monitor);
  // What contouring leaves behind for the next one is as large as a grid.
  releaseMemory();
  return mesh;
}

}  // namespace

void checkResampling(const openvdb::GridBase& grid, const openvdb::math::Transform& target) {
  Sampled sampled;
  grid.apply<SampledGrids>([&](const auto& typed) { sampled = sampledOf(typed, target); });
  if (sampled.box.empty()) return;
  for (int corner = 0; corner < 8; ++corner) {
    const openvdb::Vec3d p = target.worldToIndex(grid.indexToWorld(cornerOf(sampled.box, corner)));
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(p[axis]) < kFarthest))
        throw Error(fmt::format("the new grid would reach {:.3g} voxels from the origin; at most {:.3g}",
                                std::abs(p[axis]), kFarthest));
  }
  // A voxel and as much again for leaves that are not full. Tiles are given up.
  constexpr double kBytes = 2 * sizeof(double);
  checkVoxels(sampled.voxels, kBytes);
}

openvdb::math::Transform::Ptr cubicTransform(const openvdb::math::Transform& old, double voxelSize) {
  try {
    if (!old.isLinear() || !old.hasUniformScale()) return openvdb::math::Transform::createLinearTransform(voxelSize);
    auto target = old.copy();
    target->preScale(voxelSize / old.voxelSize()[0]);
    return target;
  } catch (const openvdb::Exception&) {
    throw Error(fmt::format("voxels of edge {:.6g} are smaller or larger than transforms can have them", voxelSize));
  }
}

void checkVoxels(double voxels, double bytesEach) {
  const double available = static_cast<double>(availableMemory()), needed = voxels * bytesEach;
  if (available > 0 && !(needed <= available))
    throw Error(
        fmt::format("the new grid would have about {:.3g} voxels and need {:.3g} GB of memory; {:.3g} GB are left",
                    voxels, needed / 1e9, available / 1e9));
}

double halfWidthOf(const GridVolume& volume) {
  double background = 0;
  volume.grid->apply<RealGrids>([&](const auto& grid) { background = static_cast<double>(grid.background()); });
  return volume.distances ? std::max(kHalfWidth, background / volume.grid->voxelSize()[0]) : kHalfWidth;
}

openvdb::GridBase::Ptr levelSetOf(const GridVolume& volume, const openvdb::math::Transform& transform, double halfWidth,
                                  bool doubles, const Monitor& monitor) {
  return levelSetFromMesh(contourFor(volume, transform, halfWidth, monitor), transform, halfWidth, doubles, monitor);
}

void rebuildLevelSet(GridVolume& volume, const openvdb::math::Transform& transform, double halfWidth,
                     const Monitor& monitor) {
  const bool doubles = volume.grid->isType<openvdb::DoubleGrid>();
  const Mesh mesh = contourFor(volume, transform, halfWidth, monitor);
  // The old grid and the new one would be in memory at a time.
  visitReal(volume, "rebuildLevelSet", [](auto& grid) { grid.clear(); });
  const openvdb::GridBase::Ptr grid = levelSetFromMesh(mesh, transform, halfWidth, doubles, monitor);
  volume.gridClass = GridClass::kLevelSet;
  replaceGrid(volume, grid);
  volume.inside = InsideValues::kLow;
  volume.iso = 0;
  volume.distances = true;
}

void ensureDistances(GridVolume& volume, const char* step, StepRecord& record, const Monitor& monitor) {
  if (volume.gridClass != GridClass::kLevelSet)
    throw Error(fmt::format("{} needs a level set, and the grid is a fog volume; --fog-to-level-set makes one", step));
  if (!volume.grid->hasUniformVoxels()) {
    const openvdb::Vec3d size = volume.grid->voxelSize();
    throw Error(
        fmt::format("{} needs voxels that are cubes, and these are {:.6g} x {:.6g} x {:.6g}{}; --resample makes "
                    "them so",
                    step, size.x(), size.y(), size.z(), size.eq(openvdb::Vec3d(size.x()), 1e-7) ? " but slanted" : ""));
  }
  if (volume.distances) return;
  if (volume.grid->empty()) {
    // What joins it later must find a band that is as wide as its own.
    visitReal(volume, step, [](auto& grid) {
      using Value = typename std::decay_t<decltype(grid)>::ValueType;
      grid.tree().root().setBackground(static_cast<Value>(kHalfWidth * grid.voxelSize()[0]), false);
    });
    volume.distances = true;
    return;
  }
  record.warn("the values are no distances in world units, in a band of 3 voxels or more; they were made so first");
  const double iso = volume.iso;
  volume.iso = 0;
  rebuildLevelSet(volume, volume.grid->transform(), kHalfWidth, monitor);
  volume.iso = iso;
}

}  // namespace pdc::detail
