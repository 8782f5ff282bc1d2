#include "io/parse/narrowing.h"

#include <limits>

namespace pdc::detail {

Vec3d chooseOrigin(const Narrowing& narrowing) {
  if (narrowing.box.isEmpty()) return {0, 0, 0};
  const Vec3d size = narrowing.box.hi - narrowing.box.lo;
  const double side = std::max({size.x, size.y, size.z});
  const bool serves = narrowing.largestError <= kMostNarrowing * side;
  if (serves || !(side > 0) || side > static_cast<double>(std::numeric_limits<float>::max())) return {0, 0, 0};
  const double step = std::exp2(std::floor(std::log2(side / 8)));
  Vec3d origin = narrowing.box.center();
  for (int axis = 0; axis < 3; ++axis) origin[axis] = std::round(origin[axis] / step) * step;
  return origin;
}

}  // namespace pdc::detail
