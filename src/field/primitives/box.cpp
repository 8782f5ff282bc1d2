#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "field/arguments.h"
#include "field/interval_arithmetic.h"
#include "field/pointwise_field.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

/// All points within `radius` of a box of half size `core`; with radius 0 that box.
struct RoundedBox {
  Vec3d center, core;
  double radius;

  /// The value as a function of the distances d = |p - center| along each axis; it does not decrease in any of them.
  [[nodiscard]] double valueAtDistances(const Vec3d& d) const {
    const Vec3d q = d - core;
    const Vec3d outside{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
    return length(outside) + std::min(std::max(std::max(q.x, q.y), q.z), 0.0) - radius;
  }

  [[nodiscard]] double value(const Vec3d& p) const {
    const Vec3d d = p - center;
    return valueAtDistances({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  }

  [[nodiscard]] detail::ValueGradient gradient(const Vec3d& p) const {
    const Vec3d d = p - center;
    const Vec3d sign{d.x < 0 ? -1.0 : 1.0, d.y < 0 ? -1.0 : 1.0, d.z < 0 ? -1.0 : 1.0};
    const Vec3d q{d.x * sign.x - core.x, d.y * sign.y - core.y, d.z * sign.z - core.z};
    const Vec3d outside{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
    const double distance = length(outside);
    Vec3d g{};
    if (distance > 0) {
      g = outside * (1 / distance);
    } else {
      g[q.x >= q.y && q.x >= q.z ? 0 : q.y >= q.z ? 1 : 2] = 1;
    }
    return {value(p), {g.x * sign.x, g.y * sign.y, g.z * sign.z}};
  }

  [[nodiscard]] Interval bound(const Box& box) const {
    const detail::AxisDistances d(box, center);
    return detail::widened({valueAtDistances(d.near), valueAtDistances(d.far)}, size() + largestEntry(box));
  }

  [[nodiscard]] double lipschitz() const { return 1; }
  [[nodiscard]] double size() const { return largestEntry(center) + largestEntry(core) + radius; }
};

}  // namespace

FieldPtr box(const Vec3d& center, const Vec3d& halfSize) {
  detail::requireFinite("box center", center);
  detail::requirePositive("box half size", halfSize);
  return detail::makePointwise(RoundedBox{center, halfSize, 0});
}

FieldPtr roundedBox(const Vec3d& center, const Vec3d& halfSize, double radius) {
  detail::requireFinite("rounded box center", center);
  detail::requirePositive("rounded box half size", halfSize);
  detail::requirePositive("rounded box radius", radius);
  const double limit = std::min({halfSize.x, halfSize.y, halfSize.z});
  if (radius > limit)
    throw std::invalid_argument(
        fmt::format("rounded box radius must be at most {}, its smallest half size, not {}", limit, radius));
  return detail::makePointwise(RoundedBox{center, halfSize - Vec3d{radius, radius, radius}, radius});
}

}  // namespace pdc
