#pragma once

#include <string_view>

#include "pdc/points/point_cloud.h"

namespace pdc::detail {

/// The points of a .pcd file (Point Cloud Library, version 0.7), ascii or binary. \throws Error, with a line's number
/// where there is one.
[[nodiscard]] PointCloud readPcdPoints(std::string_view bytes);

}  // namespace pdc::detail
