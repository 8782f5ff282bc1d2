#include "field/arguments.h"
#include "field/interval_arithmetic.h"
#include "field/pointwise_field.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

struct Sphere {
  Vec3d center;
  double radius;

  [[nodiscard]] double value(const Vec3d& p) const { return length(p - center) - radius; }

  [[nodiscard]] detail::ValueGradient gradient(const Vec3d& p) const {
    const Vec3d d = p - center;
    const double r = length(d);
    return {r - radius, r > 0 ? d * (1 / r) : Vec3d{}};
  }

  [[nodiscard]] Interval bound(const Box& box) const {
    const detail::AxisDistances d(box, center);
    return detail::widened({length(d.near) - radius, length(d.far) - radius}, size() + largestEntry(box));
  }

  [[nodiscard]] double lipschitz() const { return 1; }
  [[nodiscard]] double size() const { return largestEntry(center) + radius; }
};

}  // namespace

FieldPtr sphere(const Vec3d& center, double radius) {
  detail::requireFinite("sphere center", center);
  detail::requirePositive("sphere radius", radius);
  return detail::makePointwise(Sphere{center, radius});
}

}  // namespace pdc
