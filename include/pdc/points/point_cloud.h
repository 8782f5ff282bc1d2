#pragma once

#include <array>
#include <cstdint>

#include "pdc/math/vec3.h"
#include "pdc/mesh/buffer.h"

namespace pdc {

/// Points of surfaces, as scanners give them. A passive value that checks nothing itself: functions that take one throw
/// as checkPointCloud() does. Several threads may read one at a time.
struct PointCloud {
  Buffer<Vec3d> positions;  ///< World units.
  Buffer<Vec3f> normals;    ///< Empty, or one per point: of unit length, away from the solid; zero where not known.
  Buffer<float> sigmas;     ///< Empty, or the standard deviation of each point along each axis, in world units, >= 0.
  Buffer<std::array<std::uint8_t, 3>> colours;  ///< Empty, or red, green and blue of each point.
};

/// \throws std::invalid_argument for normals, standard deviations or colours that are not one per point; Error for a
/// cloud without points, and for the first point with a coordinate that is not finite or beyond 1e150, a normal that is
/// not finite, or a standard deviation that is negative or not finite.
void checkPointCloud(const PointCloud& cloud);

}  // namespace pdc
