#include "sample/meaning/grid_map.h"

#include <openvdb/openvdb.h>

namespace pdc::detail {
namespace {

/// The centre of what is active, in lattice units; the origin if nothing is.
Vec3d centerOfData(const openvdb::GridBase& grid) {
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) return {};
  Vec3d center;
  for (int i = 0; i < 3; ++i) center[i] = 0.5 * (static_cast<double>(box.min()[i]) + static_cast<double>(box.max()[i]));
  return center;
}

}  // namespace

LatticeMap gridMap(const openvdb::GridBase& grid) {
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

}  // namespace pdc::detail
