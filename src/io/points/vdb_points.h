#pragma once

#include <filesystem>

#include "pdc/points/point_cloud.h"

namespace pdc::detail {

/// All points of the only point grid of a .vdb file. \throws Error, or what OpenVDB throws.
[[nodiscard]] PointCloud readVdbPoints(const std::filesystem::path& path);

}  // namespace pdc::detail
