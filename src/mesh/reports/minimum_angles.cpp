#include "pdc/mesh/minimum_angles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"

namespace pdc {
namespace {

float minimumAngle(const detail::TriangleCorners& c) {
  if (!std::all_of(c.begin(), c.end(), detail::isFinite)) return std::numeric_limits<float>::quiet_NaN();
  double least = std::numbers::pi;
  for (int k = 0; k < 3; ++k) {
    const Vec3d a = vecCast<double>(c[(k + 1) % 3]) - vecCast<double>(c[k]);
    const Vec3d b = vecCast<double>(c[(k + 2) % 3]) - vecCast<double>(c[k]);
    least = std::min(least, std::atan2(length(cross(a, b)), dot(a, b)));
  }
  return static_cast<float>(least * 180 / std::numbers::pi);
}

}  // namespace

Buffer<float> minimumAngles(const Mesh& mesh) {
  detail::checkSizes(mesh, "minimumAngles");
  detail::checkIndices(mesh);
  Buffer<float> angles(detail::triangleCount(mesh));
  tbb::parallel_for(std::size_t{0}, angles.size(),
                    [&](std::size_t i) { angles[i] = minimumAngle(detail::corners(mesh, detail::triangle(mesh, i))); });
  return angles;
}

}  // namespace pdc
