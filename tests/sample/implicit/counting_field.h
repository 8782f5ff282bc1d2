#pragma once

#include <atomic>
#include <cmath>
#include <functional>
#include <utility>

#include "pdc/field/field.h"

namespace pdc::test {

/// A field from functions that counts the points it is asked for.
class CountingField final : public Field {
 public:
  using ValueFunction = std::function<double(const Vec3d&)>;
  using GradientFunction = std::function<Vec3d(const Vec3d&)>;
  using BoundFunction = std::function<Interval(const Box&)>;

  CountingField(ValueFunction value, GradientFunction gradient, BoundFunction bound)
      : mValue(std::move(value)), mGradient(std::move(gradient)), mBound(std::move(bound)) {}

  void values(PointSpan points, double* values) const override {
    mPoints += points.size;
    for (std::size_t i = 0; i < points.size; ++i) values[i] = mValue({points.x[i], points.y[i], points.z[i]});
  }
  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    for (std::size_t i = 0; i < points.size; ++i) {
      const Vec3d p{points.x[i], points.y[i], points.z[i]};
      values[i] = mValue(p);
      const Vec3d g = mGradient(p);
      gradients.x[i] = g.x;
      gradients.y[i] = g.y;
      gradients.z[i] = g.z;
    }
  }
  [[nodiscard]] Interval bound(const Box& box) const override { return mBound(box); }

  [[nodiscard]] std::size_t points() const { return mPoints; }

 private:
  ValueFunction mValue;
  GradientFunction mGradient;
  BoundFunction mBound;
  mutable std::atomic<std::size_t> mPoints{0};
};

inline Interval unknownBound(const Box&) { return Interval::whole(); }

/// Distance to a sphere about `center`; with bounds from its slope of one, or without any.
inline std::shared_ptr<CountingField> sphereField(const Vec3d& center, double radius, bool bounded = true) {
  const auto value = [=](const Vec3d& p) { return length(p - center) - radius; };
  const auto bound = [=](const Box& box) {
    const double middle = value(box.center());
    return Interval{middle - box.radius(), middle + box.radius()};
  };
  const auto gradient = [=](const Vec3d& p) { return (p - center) * (1 / length(p - center)); };
  return std::make_shared<CountingField>(value, gradient, bounded ? CountingField::BoundFunction(bound) : unknownBound);
}

/// A field of x alone, of unknown bounds, with the gradient left to difference quotients.
inline std::shared_ptr<CountingField> fieldOfX(std::function<double(double)> f) {
  return std::make_shared<CountingField>([f = std::move(f)](const Vec3d& p) { return f(p.x); },
                                         [](const Vec3d&) { return Vec3d{}; }, unknownBound);
}

}  // namespace pdc::test
