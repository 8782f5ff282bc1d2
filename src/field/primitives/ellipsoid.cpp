#include <algorithm>

#include "field/arguments.h"
#include "field/interval_arithmetic.h"
#include "field/pointwise_field.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

struct Ellipsoid {
  Vec3d center, axes;

  /// k0 = |d/r| and k1 = |d/r²|, neither of which decreases in any |d|.
  struct Norms {
    double k0, k1;
  };
  [[nodiscard]] Norms norms(const Vec3d& d) const {
    const Vec3d u{d.x / axes.x, d.y / axes.y, d.z / axes.z};
    return {length(u), length(Vec3d{u.x / axes.x, u.y / axes.y, u.z / axes.z})};
  }
  [[nodiscard]] double smallestAxis() const { return std::min(std::min(axes.x, axes.y), axes.z); }
  [[nodiscard]] double largestAxis() const { return std::max(std::max(axes.x, axes.y), axes.z); }

  [[nodiscard]] double value(const Vec3d& p) const {
    const Norms n = norms(p - center);
    // The limit at the centre depends on the direction; the one of smallest size is taken.
    return n.k1 > 0 ? (n.k0 - 1) * (n.k0 / n.k1) : -smallestAxis();
  }

  [[nodiscard]] detail::ValueGradient gradient(const Vec3d& p) const {
    const Vec3d d = p - center;
    const Norms n = norms(d);
    const double f = value(p);
    if (!(n.k1 > 0)) return {f, {}};
    const Vec3d rr{axes.x * axes.x, axes.y * axes.y, axes.z * axes.z};
    const Vec3d gradK0 = Vec3d{d.x / rr.x, d.y / rr.y, d.z / rr.z} * (1 / n.k0);
    const Vec3d gradK1 = Vec3d{d.x / (rr.x * rr.x), d.y / (rr.y * rr.y), d.z / (rr.z * rr.z)} * (1 / n.k1);
    return {f, gradK0 * ((2 * n.k0 - 1) / n.k1) - gradK1 * (f / n.k1)};
  }

  [[nodiscard]] Interval bound(const Box& box) const {
    const detail::AxisDistances d(box, center);
    const Norms lo = norms(d.near), hi = norms(d.far);
    // k0/k1 is a mean of the axes, so the range holds even at the centre, where both vanish.
    Interval ratio{smallestAxis(), largestAxis()};
    if (lo.k1 > 0) ratio = detail::intersection(ratio, {lo.k0 / hi.k1, hi.k0 / lo.k1});
    return detail::widened(detail::product({lo.k0 - 1, hi.k0 - 1}, ratio), (size() + largestEntry(box)) * flattening());
  }

  [[nodiscard]] bool definedIn(const Box& box) const {
    return smallestAxis() > 1 / detail::kUsual && size() < detail::kUsual && largestEntry(box) < detail::kUsual;
  }
  [[nodiscard]] double lipschitz() const { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] double size() const { return largestEntry(center) + largestAxis(); }

 private:
  /// How much errors of coordinates grow in a flat ellipsoid's value.
  [[nodiscard]] double flattening() const { return largestAxis() / smallestAxis(); }
};

}  // namespace

FieldPtr ellipsoid(const Vec3d& center, const Vec3d& semiAxes) {
  detail::requireFinite("ellipsoid center", center);
  detail::requirePositive("ellipsoid semi-axes", semiAxes);
  return detail::makePointwise(Ellipsoid{center, semiAxes});
}

}  // namespace pdc
