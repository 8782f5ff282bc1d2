#include "field/arguments.h"
#include "field/interval_arithmetic.h"
#include "field/pointwise_field.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

struct Plane {
  Vec3d point, normal;

  [[nodiscard]] double value(const Vec3d& p) const { return dot(p - point, normal); }
  [[nodiscard]] detail::ValueGradient gradient(const Vec3d& p) const { return {value(p), normal}; }
  [[nodiscard]] Interval bound(const Box& box) const {
    return detail::widened(detail::around(value(box.center()), detail::extent(box, normal)),
                           size() + largestEntry(box));
  }
  [[nodiscard]] double lipschitz() const { return 1; }
  [[nodiscard]] double size() const { return largestEntry(point); }
};

}  // namespace

FieldPtr plane(const Vec3d& point, const Vec3d& normal) {
  detail::requireFinite("plane point", point);
  return detail::makePointwise(Plane{point, detail::requireDirection("plane normal", normal)});
}

}  // namespace pdc
