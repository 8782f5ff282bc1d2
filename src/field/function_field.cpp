#include "pdc/field/function_field.h"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "field/arguments.h"
#include "field/boundary.h"
#include "field/central_differences.h"
#include "field/interval_arithmetic.h"

namespace pdc {
namespace {

class FunctionField final : public Field {
 public:
  explicit FunctionField(FunctionFieldOptions options) : mOptions(std::move(options)) {}

  void values(PointSpan points, double* values) const override {
    for (std::size_t i = 0; i < points.size; ++i)
      values[i] = detail::open(mOptions.value({points.x[i], points.y[i], points.z[i]}));
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    if (!mOptions.gradient) {
      const auto evaluate = [this](PointSpan all, double* result) { this->values(all, result); };
      detail::centralDifferences(points, evaluate, values, gradients);
      return;
    }
    this->values(points, values);
    for (std::size_t i = 0; i < points.size; ++i) {
      const Vec3d g = mOptions.gradient({points.x[i], points.y[i], points.z[i]});
      gradients.x[i] = g.x;
      gradients.y[i] = g.y;
      gradients.z[i] = g.z;
    }
  }

  [[nodiscard]] Interval bound(const Box& box) const override {
    if (!mOptions.lipschitz) return Interval::whole();
    return detail::lipschitzBound(mOptions.value(box.center()), *mOptions.lipschitz, box);
  }

  [[nodiscard]] double lipschitz() const override { return mOptions.lipschitz.value_or(Field::lipschitz()); }

 private:
  FunctionFieldOptions mOptions;
};

}  // namespace

FieldPtr functionField(FunctionFieldOptions options) {
  if (!options.value) throw std::invalid_argument("functionField needs a value function");
  if (options.lipschitz) detail::requirePositive("functionField lipschitz constant", *options.lipschitz);
  return std::make_shared<FunctionField>(std::move(options));
}

}  // namespace pdc
