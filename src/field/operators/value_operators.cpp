#include <cmath>
#include <memory>
#include <utility>

#include "field/arguments.h"
#include "field/boundary.h"
#include "field/interval_arithmetic.h"
#include "pdc/field/operators.h"

namespace pdc {
namespace {

/// Each operation maps a value with slope ±1, and rounds monotonically, so that it maps ranges without slack but for
/// what closed() takes for zero.
struct Complement {
  [[nodiscard]] double map(double v) const { return -v; }
  [[nodiscard]] double slope(double) const { return -1; }
  [[nodiscard]] Interval map(Interval range) const { return -range; }
};

struct Offset {
  double distance;

  [[nodiscard]] double tolerance() const { return detail::kBoundary * std::abs(distance); }
  [[nodiscard]] double map(double v) const { return detail::closed(v - distance, tolerance()); }
  [[nodiscard]] double slope(double) const { return 1; }
  [[nodiscard]] Interval map(Interval range) const { return {range.lo - distance - tolerance(), range.hi - distance}; }
};

struct Shell {
  double halfThickness;

  [[nodiscard]] double tolerance() const { return detail::kBoundary * halfThickness; }
  [[nodiscard]] double map(double v) const { return detail::closed(std::abs(v) - halfThickness, tolerance()); }
  [[nodiscard]] double slope(double v) const { return v < 0 ? -1 : 1; }
  [[nodiscard]] Interval map(Interval range) const {
    const Interval away = detail::absolute(range);
    return {away.lo - halfThickness - tolerance(), away.hi - halfThickness};
  }
};

template <typename Operation>
class ValueField final : public Field {
 public:
  ValueField(FieldPtr field, const Operation& operation) : mField(std::move(field)), mOperation(operation) {}

  void values(PointSpan points, double* values) const override {
    mField->values(points, values);
    const Operation operation = mOperation;
    for (std::size_t i = 0; i < points.size; ++i) values[i] = operation.map(values[i]);
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    mField->gradients(points, values, gradients);
    const Operation operation = mOperation;
    for (std::size_t i = 0; i < points.size; ++i) {
      const double slope = operation.slope(values[i]);
      values[i] = operation.map(values[i]);
      gradients.x[i] *= slope;
      gradients.y[i] *= slope;
      gradients.z[i] *= slope;
    }
  }

  [[nodiscard]] Interval bound(const Box& box) const override { return mOperation.map(mField->bound(box)); }
  [[nodiscard]] double lipschitz() const override { return mField->lipschitz(); }

  [[nodiscard]] std::size_t parts() const override { return mField->parts(); }
  [[nodiscard]] FieldPtr simplified(const Box& box) const override {
    FieldPtr field = mField->simplified(box);
    return field ? std::make_shared<ValueField>(std::move(field), mOperation) : nullptr;
  }
  [[nodiscard]] bool definedIn(const Box& box) const override { return mField->definedIn(box); }

 private:
  FieldPtr mField;
  Operation mOperation;
};

}  // namespace

FieldPtr complement(FieldPtr field) {
  detail::requireField("complement operand", field);
  return std::make_shared<ValueField<Complement>>(std::move(field), Complement{});
}

FieldPtr offset(FieldPtr field, double distance) {
  detail::requireField("offset operand", field);
  detail::requireFinite("offset distance", distance);
  if (distance == 0) return field;
  return std::make_shared<ValueField<Offset>>(std::move(field), Offset{distance});
}

FieldPtr shell(FieldPtr field, double thickness) {
  detail::requireField("shell operand", field);
  detail::requirePositive("shell thickness", thickness);
  return std::make_shared<ValueField<Shell>>(std::move(field), Shell{thickness / 2});
}

}  // namespace pdc
