#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "field/arguments.h"
#include "field/interval_arithmetic.h"
#include "math/lane_loops.h"
#include "pdc/field/operators.h"

namespace pdc {
namespace {

/// Whether both are zero and only b is -0.0: by its sign a zero says on which side of its boundary a solid is.
bool isLowerZero(double b, double a) {
  // Without branches, so that loops over it vectorise.
  return (a == 0) & (b == 0) & (std::bit_cast<std::int64_t>(b) < std::bit_cast<std::int64_t>(a));
}

/// Each rule says which of two values is the result, whether the fillet adds to it or takes away, and the sign of
/// operands after the first. NaN counts as outside of the operand that has it.
///
/// Without fillets the result is never beyond the limit, an end of an operand's range. An operand whose whole range is
/// beyond it neither decides nor ties.
struct Unite {
  static constexpr double kBulge = -1, kSign = 1;
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  static bool takesOther(double value, double other) {
    const bool isNan = std::isnan(value), isLower = isLowerZero(other, value);
    return (other < value) | isNan | isLower;
  }
  static double limit(double limit, Interval range) { return std::min(limit, range.hi); }
  static bool beyond(double limit, Interval range) { return range.lo > limit; }
};
/// What both kinds of max have in common.
struct Largest {
  static constexpr double kBulge = 1;
  static constexpr double kNoLimit = -std::numeric_limits<double>::infinity();
  static double limit(double limit, Interval range) { return std::max(limit, range.lo); }
  static bool beyond(double limit, Interval range) { return range.hi < limit; }
};
struct Intersect : Largest {
  static constexpr double kSign = 1;
  static bool takesOther(double value, double other) {
    const bool isNan = std::isnan(other), isLower = isLowerZero(value, other);
    return (other > value) | isNan | isLower;
  }
};
struct Subtract : Largest {
  static constexpr double kSign = -1;
  static bool takesOther(double value, double other) {
    const bool isLower = isLowerZero(value, other);
    return (other > value) | isLower;
  }
};

/// Folds the operands with min or max, rounded off where two values differ by less than the radius k:
/// min(a, b) - h²/(4k) with h = max(0, k - |a - b|). Increasing in both a and b.
template <typename Rule>
class BooleanField final : public Field {
 public:
  BooleanField(std::vector<FieldPtr> operands, double radius)
      : mOperands(std::move(operands)),
        mRadius(radius),
        mHalfInverse(radius > 0 ? 0.5 / radius : 0),
        mParts(countParts(mOperands, radius)) {}

  void values(PointSpan points, double* values) const override {
    mOperands[0]->values(points, values);
    double other[kMaxBatch];
    for (std::size_t k = 1; k < mOperands.size(); ++k) {
      mOperands[k]->values(points, other);
      if (mRadius > 0) {
        for (std::size_t i = 0; i < points.size; ++i) values[i] = combine(values[i], Rule::kSign * other[i]).value;
      } else {
        foldSharp(other, points.size, values);
      }
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
    Interval range = rangeOf(0, box);
    for (std::size_t k = 1; k < mOperands.size(); ++k) {
      const Interval other = rangeOf(k, box);
      range = {combine(range.lo, other.lo).value, combine(range.hi, other.hi).value};
    }
    return mRadius > 0 ? detail::widened(range, mRadius) : range;
  }

  [[nodiscard]] double lipschitz() const override {
    double largest = 0;
    for (const FieldPtr& f : mOperands) largest = std::max(largest, f->lipschitz());
    return largest;
  }

  [[nodiscard]] std::size_t parts() const override { return mParts; }

  [[nodiscard]] FieldPtr simplified(const Box& box) const override {
    if (mParts == 1) return nullptr;
    const std::vector<std::size_t> deciding = findDeciding(box);
    std::vector<FieldPtr> operands;
    operands.reserve(deciding.size());
    bool simpler = (mOperands.size() - deciding.size()) * kLeastShare >= mOperands.size();
    for (const std::size_t k : deciding) {
      FieldPtr operand = mOperands[k]->parts() > 1 ? mOperands[k]->simplified(box) : nullptr;
      simpler = simpler || operand;
      operands.push_back(operand ? std::move(operand) : mOperands[k]);
    }
    return simpler ? std::make_shared<BooleanField>(std::move(operands), mRadius) : nullptr;
  }

  [[nodiscard]] bool definedIn(const Box& box) const override {
    return std::all_of(mOperands.begin(), mOperands.end(), [&](const FieldPtr& f) { return f->definedIn(box); });
  }

 private:
  struct Combination {
    double value;
    bool other;     ///< Whether the other value is the active one.
    double weight;  ///< The derivative with respect to the passive value, at most 1/2.
  };

  /// One operand in so many must be left out, or it is not worth the memory.
  static constexpr std::size_t kLeastShare = 8;

  static std::size_t countParts(const std::vector<FieldPtr>& operands, double radius) {
    // Operands that are used again and again make more than a number can hold.
    constexpr std::size_t kMost = std::numeric_limits<int>::max();
    const std::size_t own = radius > 0 ? 0 : 1;
    std::size_t parts = 1 - own;
    for (const FieldPtr& f : operands) parts = std::min(kMost, parts + f->parts() - 1 + own);
    return parts;
  }

  /// The operands that may decide the value in a box, in their order. Fillets depend on all of them, and so does where
  /// the result is NaN.
  [[nodiscard]] std::vector<std::size_t> findDeciding(const Box& box) const {
    std::vector<Interval> ranges(mOperands.size());
    double limit = Rule::kNoLimit;
    for (std::size_t k = 0; k < mOperands.size(); ++k) {
      if (mRadius > 0 || !mOperands[k]->definedIn(box)) continue;
      ranges[k] = rangeOf(k, box);
      limit = Rule::limit(limit, ranges[k]);
    }
    std::vector<std::size_t> deciding;
    for (std::size_t k = 0; k < mOperands.size(); ++k)
      if (!Rule::beyond(limit, ranges[k]) || (Rule::kSign < 0 && k == 0)) deciding.push_back(k);
    return deciding;
  }

  /// The range of an operand, or of its complement where the rule takes that.
  [[nodiscard]] Interval rangeOf(std::size_t k, const Box& box) const {
    const Interval range = mOperands[k]->bound(box);
    return k > 0 && Rule::kSign < 0 ? -range : range;
  }

  void foldSharp(const double* other, std::size_t size, double* values) const {
    const auto fold = [=](std::size_t i) { values[i] = sharp(values[i], Rule::kSign * other[i]); };
    detail::forEachBatch(mLevel, size / kLanes, [fold](std::size_t batch) {
      const std::size_t first = batch * kLanes;
      detail::forEachLane([&](int lane) { fold(first + static_cast<std::size_t>(lane)); });
    });
    for (std::size_t i = size - size % kLanes; i < size; ++i) fold(i);
  }

  static double sharp(double value, double other) { return Rule::takesOther(value, other) ? other : value; }

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
  std::size_t mParts;
  SimdLevel mLevel = bestSimdLevel();
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
