#include "pdc/grid/clip.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Clip.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/GridTransformer.h>
#include <openvdb/tools/Mask.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "grid/level_set.h"
#include "grid/real_grid.h"
#include "pdc/error.h"

namespace pdc {
namespace {

using MaskGrids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid, openvdb::Int64Grid,
                                    openvdb::BoolGrid>;

void checkOptions(const ClipOptions& options) {
  if (options.mask) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = options.box.lo[axis], hi = options.box.hi[axis];
    if (!std::isfinite(lo) || !std::isfinite(hi) || !(lo < hi))
      throw std::invalid_argument("clipGrid: the box is empty or not finite");
  }
}

/// The box, but not much larger than what it cuts: its own level set would be as large as it is. Empty where it misses
/// all.
Box limitTo(const Box& box, const openvdb::GridBase& grid, double halfWidth) {
  const openvdb::CoordBBox active = grid.evalActiveVoxelBoundingBox();
  if (active.empty()) return Box::empty();
  // The bands of both must be apart where the box does not cut.
  const double pad = 2 * halfWidth + 4;
  Box limit = Box::empty();
  for (int corner = 0; corner < 8; ++corner) {
    openvdb::Vec3d p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = (corner >> axis & 1) != 0 ? active.max()[axis] + pad : active.min()[axis] - pad;
    p = grid.indexToWorld(p);
    limit.include(Vec3d{p.x(), p.y(), p.z()});
  }
  if (!limit.meets(box)) return Box::empty();
  Box both = box;
  for (int axis = 0; axis < 3; ++axis) {
    both.lo[axis] = std::max(box.lo[axis], limit.lo[axis]);
    both.hi[axis] = std::min(box.hi[axis], limit.hi[axis]);
  }
  return both;
}

Mesh boxMesh(const Box& box) {
  Mesh mesh;
  mesh.origin = box.center();
  const Vec3d half = box.halfSize();
  for (int corner = 0; corner < 8; ++corner) {
    Vec3f p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = static_cast<float>((corner >> axis & 1) != 0 ? half[axis] : -half[axis]);
    mesh.positions.push_back(p);
  }
  constexpr Quad kFaces[] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const Quad& face : kFaces) mesh.quads.push_back(face);
  return mesh;
}

template <typename GridT>
void intersectWithBox(GridT& grid, const Box& wanted, const Monitor& monitor) {
  const double halfWidth = static_cast<double>(grid.background()) / grid.voxelSize()[0];
  const Box box = limitTo(wanted, grid, halfWidth);
  if (box.isEmpty()) {
    grid.clear();
    return;
  }
  const bool doubles = std::is_same_v<GridT, openvdb::DoubleGrid>;
  const auto solid = openvdb::gridPtrCast<GridT>(
      detail::levelSetFromMesh(boxMesh(box), grid.transform(), halfWidth, doubles, monitor));
  openvdb::tools::csgIntersection(grid, *solid);
}

/// The inside of a level set, else the active voxels, on the lattice of `grid`.
openvdb::MaskGrid::Ptr maskOn(const openvdb::GridBase& grid, const openvdb::GridBase& mask) {
  openvdb::BoolGrid::Ptr bits;
  const auto take = [&](const auto& typed) { bits = openvdb::tools::interiorMask(typed); };
  if (!mask.apply<MaskGrids>(take))
    throw Error(fmt::format("a grid of type {} is no mask to clip with", mask.valueType()));
  if (bits->transform() != grid.transform()) {
    detail::checkResampling(*bits, grid.transform());
    auto moved = openvdb::BoolGrid::create(false);
    moved->setTransform(grid.transform().copy());
    openvdb::tools::resampleToMatch<openvdb::tools::PointSampler>(*bits, *moved);
    bits = moved;
  }
  const openvdb::MaskTree::Ptr tree(new openvdb::MaskTree(bits->tree(), false, true, openvdb::TopologyCopy()));
  auto result = openvdb::MaskGrid::create(tree);
  result->setTransform(grid.transform().copy());
  return result;
}

template <typename GridT>
typename GridT::Ptr clipped(const GridT& grid, const ClipOptions& options) {
  if (options.mask) {
    return openvdb::tools::clip_internal::doClip(grid, *maskOn(grid, *options.mask), /*keepInterior=*/true);
  }
  // Indices of corners far away would not be what coordinates hold.
  const Box box = limitTo(options.box, grid, 0);
  if (box.isEmpty()) {
    return grid.copyWithNewTree();
  }
  const auto toVdb = [](const Vec3d& v) { return openvdb::Vec3d(v.x, v.y, v.z); };
  return openvdb::tools::clip(grid, openvdb::BBoxd(toVdb(box.lo), toVdb(box.hi)));
}

}  // namespace

void clipGrid(GridVolume& volume, const ClipOptions& options, GridStepReport* report, const Monitor& monitor) {
  checkOptions(options);
  monitor.throwIfStopped();
  detail::StepRecord record(volume, report);
  const bool closes = volume.gridClass == GridClass::kLevelSet && options.closed && !options.mask;
  if (closes) detail::ensureDistances(volume, "clipping a solid with a box", record, monitor);
  detail::visitReal(volume, "clipGrid", [&](auto& grid) {
    if (closes) {
      intersectWithBox(grid, options.box, monitor);
    } else {
      detail::replaceGrid(volume, clipped(grid, options));
    }
  });
  record.finish(volume);
}

}  // namespace pdc
