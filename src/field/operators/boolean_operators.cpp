#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "field/arguments.h"
#include "field/interval_arithmetic.h"
#include "pdc/field/operators.h"

namespace pdc {
namespace {

/// Whether both are zero and only b is -0.0: by its sign a zero says on which side of its boundary a solid is.
bool isLowerZero(double b, double a) { return a == 0 && b == 0 && std::signbit(b) && !std::signbit(a); }

/// Each rule says which of two values is the result, whether the fillet adds to it or takes away, and the sign of
/// operands after the first. NaN counts as outside of the operand that has it.
struct Unite {
  static constexpr double kBulge = -1, kSign = 1;
  static bool takesOther(double value, double other) {
    return other < value || std::isnan(value) || isLowerZero(other, value);
  }
};
struct Intersect {
  static constexpr double kBulge = 1, kSign = 1;
  static bool takesOther(double value, double other) {
    return other > value || std::isnan(other) || isLowerZero(value, other);
  }
};
struct Subtract {
  static constexpr double kBulge = 1, kSign = -1;
  static bool takesOther(double value, double other) { return other > value || isLowerZero(value, other); }
};

/// Folds the operands with min or max, rounded off where two values differ by less than the radius k:
/// min(a, b) - h²/(4k) with h = max(0, k - |a - b|). Increasing in both a and b.
template <typename Rule>
class BooleanField final : public Field {
 public:
  BooleanField(std::vector<FieldPtr> operands, double radius)
      : mOperands(std::move(operands)), mRadius(radius), mHalfInverse(radius > 0 ? 0.5 / radius : 0) {}

  void values(PointSpan points, double* values) const override {
    mOperands[0]->values(points, values);
    double other[kMaxBatch];
    for (std::size_t k = 1; k < mOperands.size(); ++k) {
      mOperands[k]->values(points, other);
      for (std::size_t i = 0; i < points.size; ++i) values[i] = combine(values[i], Rule::kSign * other[i]).value;
    }
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    mOperands[0]->gradients(points, values, gradients);
    double other[kMaxBatch], x[kMaxBatch], y[kMaxBatch], z[kMaxBatch];
    for (std::size_t k = 1; k < mOperands.size(); ++k) {
      mOperands[k]->gradients(points, other, {x, y, z});
      for (std::size_t i = 0; i < points.size; ++i) {
        const Combination c = combine(values[i], Rule::kSign * other[i]);
        values[i] = c.value;
        gradients.x[i] = mix(c, gradients.x[i], Rule::kSign * x[i]);
        gradients.y[i] = mix(c, gradients.y[i], Rule::kSign * y[i]);
        gradients.z[i] = mix(c, gradients.z[i], Rule::kSign * z[i]);
      }
    }
  }

  [[nodiscard]] Interval bound(const Box& box) const override {
    Interval range = mOperands[0]->bound(box);
    for (std::size_t k = 1; k < mOperands.size(); ++k) {
      const Interval b = mOperands[k]->bound(box);
      const Interval other = Rule::kSign > 0 ? b : -b;
      range = {combine(range.lo, other.lo).value, combine(range.hi, other.hi).value};
    }
    return mRadius > 0 ? detail::widened(range, mRadius) : range;
  }

  [[nodiscard]] double lipschitz() const override {
    double largest = 0;
    for (const FieldPtr& f : mOperands) largest = std::max(largest, f->lipschitz());
    return largest;
  }

 private:
  struct Combination {
    double value;
    bool other;     ///< Whether the other value is the active one.
    double weight;  ///< The derivative with respect to the passive value, at most 1/2.
  };

  [[nodiscard]] Combination combine(double value, double other) const {
    const bool takesOther = Rule::takesOther(value, other);
    // In this order of arguments max() makes NaN 0.
    const double fillet = std::max(0.0, mRadius - std::abs(value - other));
    const double weight = fillet * mHalfInverse;
    const double sharp = takesOther ? other : value;
    // Adding nothing would turn -0.0 into +0.0.
    return {fillet > 0 ? sharp + Rule::kBulge * 0.5 * fillet * weight : sharp, takesOther, weight};
  }

  /// A weighted mean, but where the weight is zero even NaN of the passive operand leaves no trace.
  [[nodiscard]] static double mix(const Combination& c, double own, double other) {
    const double active = c.other ? other : own, passive = c.other ? own : other;
    return c.weight > 0 ? active + (passive - active) * c.weight : active;
  }

  std::vector<FieldPtr> mOperands;
  double mRadius;
  double mHalfInverse;
};

template <typename Rule>
FieldPtr makeSharp(const char* what, std::vector<FieldPtr>&& operands, double radius = 0) {
  if (operands.empty()) throw std::invalid_argument(std::string(what) + " needs at least one operand, not 0");
  for (const FieldPtr& f : operands) detail::requireField(what, f);
  return std::make_shared<BooleanField<Rule>>(std::move(operands), radius);
}

template <typename Rule>
FieldPtr makeSmooth(const char* what, std::vector<FieldPtr>&& operands, double radius) {
  detail::requirePositive("fillet radius", radius);
  return makeSharp<Rule>(what, std::move(operands), radius);
}

}  // namespace

FieldPtr unite(std::vector<FieldPtr> operands) { return makeSharp<Unite>("unite operand", std::move(operands)); }

FieldPtr intersect(std::vector<FieldPtr> operands) {
  return makeSharp<Intersect>("intersect operand", std::move(operands));
}

FieldPtr subtract(std::vector<FieldPtr> operands) {
  return makeSharp<Subtract>("subtract operand", std::move(operands));
}

FieldPtr smoothUnite(std::vector<FieldPtr> operands, double radius) {
  return makeSmooth<Unite>("smoothUnite operand", std::move(operands), radius);
}

FieldPtr smoothIntersect(std::vector<FieldPtr> operands, double radius) {
  return makeSmooth<Intersect>("smoothIntersect operand", std::move(operands), radius);
}

FieldPtr smoothSubtract(std::vector<FieldPtr> operands, double radius) {
  return makeSmooth<Subtract>("smoothSubtract operand", std::move(operands), radius);
}

}  // namespace pdc
