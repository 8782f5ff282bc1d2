#include <cmath>
#include <numbers>

#include "field/arguments.h"
#include "field/interval_arithmetic.h"
#include "field/pointwise_field.h"
#include "field/primitives/sine_cosine.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

using detail::product;
using detail::SineCosine;
using detail::sineCosine;
using detail::sum;

constexpr double kTwoPi = 2 * std::numbers::pi;

bool containsMultipleOf2Pi(Interval x) { return std::ceil(x.lo / kTwoPi) <= std::floor(x.hi / kTwoPi); }

Interval cosine(Interval x) {
  if (!(x.hi - x.lo < kTwoPi)) return {-1, 1};
  Interval range = detail::hull({std::cos(x.lo), std::cos(x.lo)}, {std::cos(x.hi), std::cos(x.hi)});
  if (containsMultipleOf2Pi(x)) range.hi = 1;
  if (containsMultipleOf2Pi(x + std::numbers::pi)) range.lo = -1;
  return range;
}

Interval sine(Interval x) { return cosine(x + -std::numbers::pi / 2); }

/// g(u) = sin x cos y + sin y cos z + sin z cos x at u = (x, y, z).
struct Gyroid {
  double wave;       ///< 2π / period.
  double thickness;  ///< The solid is g < 0 if this is 0, otherwise |g| < thickness.

  /// |∇g| <= √3: the first entry is (cos x, sin x)·(cos y, -sin z), so its square is at most cos²y + sin²z; the others
  /// are alike, and the three sum to 3.
  [[nodiscard]] double scale() const { return 1 / (std::numbers::sqrt3 * wave); }

  [[nodiscard]] double value(const Vec3d& p) const {
    const Vec3d u = p * wave;
    const SineCosine x = sineCosine(u.x), y = sineCosine(u.y), z = sineCosine(u.z);
    const double g = x.sine * y.cosine + y.sine * z.cosine + z.sine * x.cosine;
    return ((thickness > 0 ? std::abs(g) : g) - thickness) * scale();
  }

  [[nodiscard]] detail::ValueGradient gradient(const Vec3d& p) const {
    const Vec3d u = p * wave;
    const SineCosine x = sineCosine(u.x), y = sineCosine(u.y), z = sineCosine(u.z);
    const double g = x.sine * y.cosine + y.sine * z.cosine + z.sine * x.cosine;
    const double slope = (thickness > 0 && g < 0 ? -1 : 1) * wave * scale();
    return {((thickness > 0 ? std::abs(g) : g) - thickness) * scale(),
            Vec3d{x.cosine * y.cosine - z.sine * x.sine, y.cosine * z.cosine - x.sine * y.sine,
                  z.cosine * x.cosine - y.sine * z.sine} *
                slope};
  }

  [[nodiscard]] Interval bound(const Box& box) const {
    Interval s[3], c[3];
    for (int i = 0; i < 3; ++i) {
      const Interval u = product({box.lo[i], box.hi[i]}, wave);
      s[i] = sine(u);
      c[i] = cosine(u);
    }
    const Interval direct = sum(sum(product(s[0], c[1]), product(s[1], c[2])), product(s[2], c[0]));
    // The mean value form adds how far g can get from its value at the centre along each axis.
    const Vec3d middle = box.center() * wave, half = box.halfSize() * wave;
    double change = 0;
    for (int i = 0; i < 3; ++i) {
      const int next = (i + 1) % 3, last = (i + 2) % 3;
      const Interval slope = detail::difference(product(c[i], c[next]), product(s[last], s[i]));
      change += detail::absolute(slope).hi * half[i];
    }
    const double atCenter = std::sin(middle.x) * std::cos(middle.y) + std::sin(middle.y) * std::cos(middle.z) +
                            std::sin(middle.z) * std::cos(middle.x);
    Interval g = detail::intersection(direct, detail::around(atCenter, change));
    if (thickness > 0) g = detail::absolute(g) + -thickness;
    return detail::widened(product(g, scale()), largestEntry(box) + (1 + thickness) * scale());
  }

  [[nodiscard]] bool definedIn(const Box& box) const {
    return wave > 1 / detail::kUsual && wave < detail::kUsual && thickness < detail::kUsual &&
           largestEntry(box) < detail::kUsual;
  }
  [[nodiscard]] double lipschitz() const { return 1; }
};

}  // namespace

FieldPtr gyroid(double period, double thickness) {
  detail::requirePositive("gyroid period", period);
  detail::requireNotNegative("gyroid thickness", thickness);
  return detail::makePointwise(Gyroid{kTwoPi / period, thickness});
}

}  // namespace pdc
