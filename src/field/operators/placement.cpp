#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "field/arguments.h"
#include "field/image_box.h"
#include "field/interval_arithmetic.h"
#include "pdc/field/operators.h"

namespace pdc {
namespace {

/// f at p is valueScale times the operand at linear · (p - origin).
struct Placement {
  Mat3d linear, inverse;
  Vec3d origin;
  double valueScale;
  double stretch;  ///< Not less than the norm of `linear`.
};

/// Translation, rotation and scale, in any number and order, as one map: chains cost no more than one of them, and
/// their bounds do not grow from link to link.
class PlacedField final : public Field {
 public:
  PlacedField(FieldPtr field, const Placement& placement) : mField(std::move(field)), mPlacement(placement) {
    for (const Vec3d& row : mPlacement.linear.row)
      mAligned = mAligned && (row.x != 0) + (row.y != 0) + (row.z != 0) == 1;
  }

  void values(PointSpan points, double* values) const override {
    double x[kMaxBatch], y[kMaxBatch], z[kMaxBatch];
    toLocal(points, x, y, z);
    mField->values({x, y, z, points.size}, values);
    const double scale = mPlacement.valueScale;
    for (std::size_t i = 0; i < points.size; ++i) values[i] *= scale;
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    double x[kMaxBatch], y[kMaxBatch], z[kMaxBatch];
    toLocal(points, x, y, z);
    mField->gradients({x, y, z, points.size}, values, gradients);
    const double scale = mPlacement.valueScale;
    const Mat3d pullBack = mPlacement.linear.transposed() * scale;
    for (std::size_t i = 0; i < points.size; ++i) {
      const Vec3d g = pullBack * Vec3d{gradients.x[i], gradients.y[i], gradients.z[i]};
      values[i] *= scale;
      gradients.x[i] = g.x;
      gradients.y[i] = g.y;
      gradients.z[i] = g.z;
    }
  }

  [[nodiscard]] Interval bound(const Box& box) const override {
    const Box local = detail::imageBox(mPlacement.linear, mPlacement.origin, box);
    Interval range = mField->bound(local);
    const double slope = mField->lipschitz();
    // Boxes about turned boxes grow from one rotation to the next, the reach about the centre does not. It is left out
    // for a box that is hardly more than a point, as the centre is here, or else nested rotations would double the work
    // each time.
    const bool pointLike = box.radius() <= kPointLike * largestEntry(box);
    if (!mAligned && !pointLike && std::isfinite(slope)) {
      const Interval atCenter = mField->bound({local.center(), local.center()});
      const double reach = slope * localRadius(box);
      range = detail::intersection(range, detail::widened({atCenter.lo - reach, atCenter.hi + reach}, reach));
    }
    return detail::product(range, mPlacement.valueScale);
  }

  [[nodiscard]] double lipschitz() const override {
    return mPlacement.valueScale * mPlacement.stretch * mField->lipschitz();
  }

  [[nodiscard]] std::size_t parts() const override { return mField->parts(); }

  [[nodiscard]] FieldPtr simplified(const Box& box) const override {
    if (parts() == 1) return nullptr;
    FieldPtr field = mField->simplified(detail::imageBox(mPlacement.linear, mPlacement.origin, box));
    return field ? std::make_shared<PlacedField>(std::move(field), mPlacement) : nullptr;
  }

  [[nodiscard]] bool definedIn(const Box& box) const override {
    const double largest = std::max({mPlacement.stretch, largestEntry(mPlacement.origin), largestEntry(box)});
    return largest < detail::kUsual && mPlacement.valueScale > 1 / detail::kUsual &&
           mPlacement.valueScale < detail::kUsual &&
           mField->definedIn(detail::imageBox(mPlacement.linear, mPlacement.origin, box));
  }

  /// Applies `outer` around `field`, merged with its own placement if it has one.
  static FieldPtr place(FieldPtr field, const Placement& outer) {
    const auto* placed = dynamic_cast<const PlacedField*>(field.get());
    if (placed == nullptr) return std::make_shared<PlacedField>(std::move(field), outer);
    const Placement& inner = placed->mPlacement;
    return std::make_shared<PlacedField>(
        placed->mField, Placement{inner.linear * outer.linear, outer.inverse * inner.inverse,
                                  outer.origin + outer.inverse * inner.origin, outer.valueScale * inner.valueScale,
                                  outer.stretch * inner.stretch});
  }

 private:
  void toLocal(PointSpan points, double* x, double* y, double* z) const {
    const Mat3d m = mPlacement.linear;
    const Vec3d origin = mPlacement.origin;
    for (std::size_t i = 0; i < points.size; ++i) {
      const Vec3d p = m * (Vec3d{points.x[i], points.y[i], points.z[i]} - origin);
      x[i] = p.x;
      y[i] = p.y;
      z[i] = p.z;
    }
  }

  /// The largest distance of the image of a corner from the image of the centre.
  [[nodiscard]] double localRadius(const Box& box) const {
    const Vec3d h = box.halfSize();
    double radius = 0;
    for (const Vec3d& diagonal : {h, Vec3d{-h.x, h.y, h.z}, Vec3d{h.x, -h.y, h.z}, Vec3d{h.x, h.y, -h.z}})
      radius = std::max(radius, length(mPlacement.linear * diagonal));
    return radius;
  }

  static constexpr double kPointLike = 1e-10;

  FieldPtr mField;
  Placement mPlacement;
  bool mAligned = true;  ///< Whether boxes stay axis-aligned.
};

/// Cosine and sine, exact for right angles.
std::pair<double, double> cosineAndSine(double degrees) {
  const double angle = std::remainder(degrees, 360.0);
  if (angle == 0) return {1, 0};
  if (std::abs(angle) == 90) return {0, angle > 0 ? 1 : -1};
  if (std::abs(angle) == 180) return {-1, 0};
  const double radians = angle * (std::numbers::pi / 180);
  return {std::cos(radians), std::sin(radians)};
}

}  // namespace

FieldPtr translate(FieldPtr field, const Vec3d& by) {
  detail::requireField("translate operand", field);
  detail::requireFinite("translation", by);
  return PlacedField::place(std::move(field), {Mat3d::identity(), Mat3d::identity(), by, 1, 1});
}

Mat3d rotation(const Vec3d& axis, double degrees) {
  const Vec3d n = detail::requireDirection("rotation axis", axis);
  detail::requireFinite("rotation angle", degrees);
  const auto [c, s] = cosineAndSine(degrees);
  const double t = 1 - c;
  return {{Vec3d{t * n.x * n.x + c, t * n.x * n.y - s * n.z, t * n.x * n.z + s * n.y},
           Vec3d{t * n.x * n.y + s * n.z, t * n.y * n.y + c, t * n.y * n.z - s * n.x},
           Vec3d{t * n.x * n.z - s * n.y, t * n.y * n.z + s * n.x, t * n.z * n.z + c}}};
}

FieldPtr rotate(FieldPtr field, const Vec3d& axis, double degrees) {
  detail::requireField("rotate operand", field);
  const Mat3d r = rotation(axis, degrees);
  return PlacedField::place(std::move(field), {r.transposed(), r, {}, 1, 1});
}

FieldPtr scale(FieldPtr field, double factor) {
  detail::requireField("scale operand", field);
  detail::requirePositive("scale factor", factor);
  return scale(std::move(field), Vec3d{factor, factor, factor});
}

FieldPtr scale(FieldPtr field, const Vec3d& factors) {
  detail::requireField("scale operand", field);
  detail::requirePositive("scale factors", factors);
  const double smallest = std::min({factors.x, factors.y, factors.z});
  return PlacedField::place(std::move(field), {Mat3d::diagonal(1 / factors.x, 1 / factors.y, 1 / factors.z),
                                               Mat3d::diagonal(factors.x, factors.y, factors.z),
                                               {},
                                               smallest,
                                               1 / smallest});
}

}  // namespace pdc
