#pragma once

#include <openvdb/Grid.h>

#include <functional>

#include "pdc/math/vec3.h"

namespace pdc {

/// A scalar grid as a function of points in world space: trilinear between voxels, through the grid's own transform;
/// active and inactive voxels count alike, and outside of what is stored it is the background. NaN and infinite voxels
/// are passed on. Several threads may call it at a time. It shares ownership of the grid, which must not change while
/// it lives. \throws Error for other types than float and double; std::invalid_argument for null.
[[nodiscard]] std::function<double(const Vec3d&)> gridFunction(const openvdb::GridBase::ConstPtr& grid);

}  // namespace pdc
