#pragma once

#include <span>

#include "pdc/points/point_cloud.h"

namespace pdc::detail {

/// Points from text, a line each: see readPoints(). \param bytes whose commas and line ends are changed. \throws Error
/// with the line's number.
[[nodiscard]] PointCloud readTextPoints(std::span<char> bytes);

}  // namespace pdc::detail
