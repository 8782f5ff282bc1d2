#pragma once

#include <concepts>
#include <memory>
#include <type_traits>

#include "math/lane_loops.h"
#include "pdc/field/field.h"

namespace pdc::detail {

struct ValueGradient {
  double value;
  Vec3d gradient;
};

/// A field written for one point: plain numbers and four functions. gradient() gives the same value as value(), bit for
/// bit.
template <typename Shape>
concept PointShape = std::is_trivially_copyable_v<Shape> &&
    requires(const Shape& shape, const Vec3d& p, const Box& box) {
  { shape.value(p) } -> std::same_as<double>;
  { shape.gradient(p) } -> std::same_as<ValueGradient>;
  { shape.bound(box) } -> std::same_as<Interval>;
  { shape.lipschitz() } -> std::same_as<double>;
};

/// Turns a shape into a field: the batch loops, compiled for every SimdLevel, with the same bits from each.
template <PointShape Shape>
class PointwiseField final : public Field {
 public:
  explicit PointwiseField(const Shape& shape) : mShape(shape) {}

  void values(PointSpan points, double* values) const override {
    forEachBlock(mLevel, points.size / kLanes, [&](std::size_t block) {
      const std::size_t first = block * kLanes;
      const double *x = points.x + first, *y = points.y + first, *z = points.z + first;
      double* f = values + first;
      // A copy: what `values` points to might be mShape, as far as the compiler knows.
      const Shape shape = mShape;
      forEachLane([&](int lane) { f[lane] = shape.value({x[lane], y[lane], z[lane]}); });
    });
    for (std::size_t i = points.size - points.size % kLanes; i < points.size; ++i)
      values[i] = mShape.value({points.x[i], points.y[i], points.z[i]});
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    forEachBlock(mLevel, points.size / kLanes, [&](std::size_t block) {
      const std::size_t first = block * kLanes;
      const double *x = points.x + first, *y = points.y + first, *z = points.z + first;
      double *f = values + first, *gx = gradients.x + first, *gy = gradients.y + first, *gz = gradients.z + first;
      const Shape shape = mShape;
      forEachLane([&](int lane) {
        const ValueGradient at = shape.gradient({x[lane], y[lane], z[lane]});
        f[lane] = at.value;
        gx[lane] = at.gradient.x;
        gy[lane] = at.gradient.y;
        gz[lane] = at.gradient.z;
      });
    });
    for (std::size_t i = points.size - points.size % kLanes; i < points.size; ++i) {
      const ValueGradient at = mShape.gradient({points.x[i], points.y[i], points.z[i]});
      values[i] = at.value;
      gradients.x[i] = at.gradient.x;
      gradients.y[i] = at.gradient.y;
      gradients.z[i] = at.gradient.z;
    }
  }

  [[nodiscard]] Interval bound(const Box& box) const override { return mShape.bound(box); }
  [[nodiscard]] double lipschitz() const override { return mShape.lipschitz(); }

 private:
  Shape mShape;
  SimdLevel mLevel = bestSimdLevel();
};

template <PointShape Shape>
FieldPtr makePointwise(const Shape& shape) {
  return std::make_shared<PointwiseField<Shape>>(shape);
}

}  // namespace pdc::detail
