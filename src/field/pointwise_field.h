#pragma once

#include <concepts>
#include <memory>
#include <type_traits>

#include "field/boundary.h"
#include "field/interval_arithmetic.h"
#include "math/lane_loops.h"
#include "pdc/field/field.h"

namespace pdc::detail {

struct ValueGradient {
  double value;
  Vec3d gradient;
};

/// A field written for one point: plain numbers and four functions. gradient() gives the same value as value(), bit for
/// bit. A shape that holds its boundary also has size(), the largest number that places it; if that and the points are
/// kUsual it has values, unless it says itself where, as Field::definedIn() does.
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
  explicit PointwiseField(const Shape& shape) : mShape(shape) {
    if constexpr (kClosed) mTolerance = kBoundary * shape.size();
  }

  void values(PointSpan points, double* values) const override {
    // The shape is copied, because `values` might point to mShape as far as the compiler knows.
    forEachPoint(points.size, [=, shape = mShape, tolerance = mTolerance](std::size_t i) {
      values[i] = onBoundary(shape.value({points.x[i], points.y[i], points.z[i]}), tolerance);
    });
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    forEachPoint(points.size, [=, shape = mShape, tolerance = mTolerance](std::size_t i) {
      const ValueGradient f = shape.gradient({points.x[i], points.y[i], points.z[i]});
      values[i] = onBoundary(f.value, tolerance);
      gradients.x[i] = f.gradient.x;
      gradients.y[i] = f.gradient.y;
      gradients.z[i] = f.gradient.z;
    });
  }

  [[nodiscard]] Interval bound(const Box& box) const override { return mShape.bound(box); }
  [[nodiscard]] double lipschitz() const override { return mShape.lipschitz(); }

  [[nodiscard]] bool definedIn(const Box& box) const override {
    if constexpr (requires { mShape.definedIn(box); }) return mShape.definedIn(box);
    if constexpr (kClosed) return mShape.size() < kUsual && largestEntry(box) < kUsual;
    return false;
  }

 private:
  static constexpr bool kClosed = requires(const Shape& shape) { shape.size(); };

  static double onBoundary(double value, double tolerance) { return kClosed ? closed(value, tolerance) : open(value); }

  /// Calls f(i) for i = 0 … size − 1, in batches as long as they are full.
  template <typename F>
  void forEachPoint(std::size_t size, const F& f) const {
    forEachBatch(mLevel, size / kLanes, [f](std::size_t batch) {
      const std::size_t first = batch * kLanes;
      forEachLane([&](int lane) { f(first + static_cast<std::size_t>(lane)); });
    });
    for (std::size_t i = size - size % kLanes; i < size; ++i) f(i);
  }

  Shape mShape;
  double mTolerance = 0;
  SimdLevel mLevel = bestSimdLevel();
};

template <PointShape Shape>
FieldPtr makePointwise(const Shape& shape) {
  return std::make_shared<PointwiseField<Shape>>(shape);
}

}  // namespace pdc::detail
