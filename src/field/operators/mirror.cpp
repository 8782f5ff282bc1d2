#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "field/arguments.h"
#include "field/interval_arithmetic.h"
#include "pdc/field/operators.h"

namespace pdc {
namespace {

class MirroredField final : public Field {
 public:
  MirroredField(FieldPtr field, int axis) : mField(std::move(field)), mAxis(axis) {}

  void values(PointSpan points, double* values) const override {
    double folded[kMaxBatch];
    mField->values(fold(points, folded), values);
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    double folded[kMaxBatch];
    mField->gradients(fold(points, folded), values, gradients);
    const double* p = coordinate(points);
    double* g = mAxis == 0 ? gradients.x : mAxis == 1 ? gradients.y : gradients.z;
    for (std::size_t i = 0; i < points.size; ++i) g[i] = p[i] < 0 ? -g[i] : g[i];
  }

  [[nodiscard]] Interval bound(const Box& box) const override { return mField->bound(fold(box)); }

  [[nodiscard]] double lipschitz() const override { return mField->lipschitz(); }

  [[nodiscard]] std::size_t parts() const override { return mField->parts(); }
  [[nodiscard]] FieldPtr simplified(const Box& box) const override {
    FieldPtr field = mField->simplified(fold(box));
    return field ? std::make_shared<MirroredField>(std::move(field), mAxis) : nullptr;
  }
  [[nodiscard]] bool definedIn(const Box& box) const override { return mField->definedIn(fold(box)); }

 private:
  [[nodiscard]] const double* coordinate(PointSpan points) const {
    return mAxis == 0 ? points.x : mAxis == 1 ? points.y : points.z;
  }

  [[nodiscard]] Box fold(Box box) const {
    const Interval distance = detail::absolute({box.lo[mAxis], box.hi[mAxis]});
    box.lo[mAxis] = distance.lo;
    box.hi[mAxis] = distance.hi;
    return box;
  }

  PointSpan fold(PointSpan points, double* folded) const {
    const double* p = coordinate(points);
    for (std::size_t i = 0; i < points.size; ++i) folded[i] = std::abs(p[i]);
    (mAxis == 0 ? points.x : mAxis == 1 ? points.y : points.z) = folded;
    return points;
  }

  FieldPtr mField;
  int mAxis;
};

}  // namespace

FieldPtr mirror(FieldPtr field, int axis) {
  detail::requireField("mirror operand", field);
  if (axis < 0 || axis > 2) throw std::invalid_argument("mirror axis must be 0, 1 or 2, not " + std::to_string(axis));
  return std::make_shared<MirroredField>(std::move(field), axis);
}

}  // namespace pdc
