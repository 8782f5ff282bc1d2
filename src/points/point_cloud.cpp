#include "pdc/points/point_cloud.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "pdc/error.h"

namespace pdc {
namespace {

/// Squares of larger coordinates, and their sums, would overflow.
constexpr double kMostCoordinate = 1e150;

bool isFinite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

void checkPointCloud(const PointCloud& cloud) {
  const std::size_t n = cloud.positions.size();
  const auto fits = [n](const auto& values) { return values.empty() || values.size() == n; };
  if (!fits(cloud.normals) || !fits(cloud.sigmas) || !fits(cloud.colours))
    throw std::invalid_argument(
        fmt::format("PointCloud: {} normals, {} standard deviations and {} colours for {} points", cloud.normals.size(),
                    cloud.sigmas.size(), cloud.colours.size(), n));
  if (n == 0) throw Error("there are no points");
  for (std::size_t i = 0; i < n; ++i) {
    const double most =
        std::abs(cloud.positions[i].x) + std::abs(cloud.positions[i].y) + std::abs(cloud.positions[i].z);
    if (!(most <= kMostCoordinate))
      throw Error(fmt::format("point {} has a coordinate that is not finite or beyond {:g}", i, kMostCoordinate));
    if (!cloud.normals.empty() && !isFinite(cloud.normals[i]))
      throw Error(fmt::format("the normal of point {} is not finite", i));
    if (!cloud.sigmas.empty() && !(cloud.sigmas[i] >= 0 && std::isfinite(cloud.sigmas[i])))
      throw Error(fmt::format("the standard deviation of point {} is {}; it must be finite and at least 0", i,
                              cloud.sigmas[i]));
  }
}

}  // namespace pdc
