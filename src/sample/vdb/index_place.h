#pragma once

#include <openvdb/math/Transform.h>

#include "pdc/math/vec3.h"

namespace pdc::detail {

/// Where a point of world space lies in index space, cut off where no grid reaches, so that coordinates and their
/// neighbours' are whole numbers that int holds; NaN becomes a number, too.
[[nodiscard]] inline openvdb::Vec3d indexPlace(const openvdb::math::Transform& transform, const Vec3d& world) {
  constexpr double kFarthest = 1 << 29;
  openvdb::Vec3d place = transform.worldToIndex(openvdb::Vec3d(world.x, world.y, world.z));
  for (int axis = 0; axis < 3; ++axis)
    place[axis] = place[axis] > -kFarthest ? (place[axis] < kFarthest ? place[axis] : kFarthest) : -kFarthest;
  return place;
}

}  // namespace pdc::detail
