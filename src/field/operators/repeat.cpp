#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "field/arguments.h"
#include "field/interval_arithmetic.h"
#include "pdc/field/operators.h"

namespace pdc {
namespace {

/// Folds one coordinate into the original's cell [-period/2, period/2].
struct AxisRepeat {
  double period;  ///< 0 where there are no copies.
  double count;   ///< Copies in either direction from the original; may be infinite.

  /// The number of the copy that a coordinate falls into; it does not decrease with x.
  [[nodiscard]] double copy(double x) const { return std::min(std::max(std::floor(x / period + 0.5), -count), count); }
  [[nodiscard]] double fold(double x) const { return period > 0 ? x - period * copy(x) : x; }

  /// The image of a range: one piece, or two where it crosses one border between copies.
  struct Pieces {
    std::array<Interval, 2> piece;
    int size;
  };
  [[nodiscard]] Pieces fold(Interval x) const {
    if (period == 0) return {{x}, 1};
    const double first = copy(x.lo), last = copy(x.hi);
    if (first == last) return {{Interval{x.lo - period * first, x.hi - period * first}}, 1};
    // A coordinate beside a border may be counted to either copy, so each reaches a little beyond its half period.
    const double half = period / 2 + kRounding * (std::abs(x.lo) + std::abs(x.hi) + period);
    const Interval lower{std::min(x.lo - period * first, half), half};
    const Interval upper{-half, std::max(x.hi - period * last, -half)};
    if (last - first > 1) return {{detail::hull(lower, upper)}, 1};
    return {{lower, upper}, 2};
  }

  static constexpr double kRounding = 1e-14;
};

class RepeatedField final : public Field {
 public:
  RepeatedField(FieldPtr field, const std::array<AxisRepeat, 3>& axes) : mField(std::move(field)), mAxes(axes) {}

  void values(PointSpan points, double* values) const override {
    double x[kMaxBatch], y[kMaxBatch], z[kMaxBatch];
    mField->values(fold(points, x, y, z), values);
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    double x[kMaxBatch], y[kMaxBatch], z[kMaxBatch];
    mField->gradients(fold(points, x, y, z), values, gradients);
  }

  [[nodiscard]] Interval bound(const Box& box) const override {
    const auto x = mAxes[0].fold({box.lo.x, box.hi.x});
    const auto y = mAxes[1].fold({box.lo.y, box.hi.y});
    const auto z = mAxes[2].fold({box.lo.z, box.hi.z});
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Interval range{kInfinity, -kInfinity};
    for (int i = 0; i < x.size; ++i)
      for (int j = 0; j < y.size; ++j)
        for (int k = 0; k < z.size; ++k)
          range = detail::hull(range, mField->bound({{x.piece[i].lo, y.piece[j].lo, z.piece[k].lo},
                                                     {x.piece[i].hi, y.piece[j].hi, z.piece[k].hi}}));
    return range;
  }

  [[nodiscard]] std::size_t parts() const override { return mField->parts(); }
  [[nodiscard]] FieldPtr simplified(const Box& box) const override {
    if (parts() == 1) return nullptr;
    FieldPtr field = mField->simplified(fold(box));
    return field ? std::make_shared<RepeatedField>(std::move(field), mAxes) : nullptr;
  }
  [[nodiscard]] bool definedIn(const Box& box) const override { return mField->definedIn(fold(box)); }

 private:
  /// A box about all that a box becomes.
  [[nodiscard]] Box fold(const Box& box) const {
    Box folded;
    for (int axis = 0; axis < 3; ++axis) {
      const AxisRepeat::Pieces pieces = mAxes[axis].fold({box.lo[axis], box.hi[axis]});
      const Interval all = detail::hull(pieces.piece[0], pieces.piece[pieces.size - 1]);
      folded.lo[axis] = all.lo;
      folded.hi[axis] = all.hi;
    }
    return folded;
  }

  PointSpan fold(PointSpan points, double* x, double* y, double* z) const {
    const std::array<AxisRepeat, 3> axes = mAxes;
    for (std::size_t i = 0; i < points.size; ++i) x[i] = axes[0].fold(points.x[i]);
    for (std::size_t i = 0; i < points.size; ++i) y[i] = axes[1].fold(points.y[i]);
    for (std::size_t i = 0; i < points.size; ++i) z[i] = axes[2].fold(points.z[i]);
    return {x, y, z, points.size};
  }

  FieldPtr mField;
  std::array<AxisRepeat, 3> mAxes;
};

}  // namespace

FieldPtr repeat(FieldPtr field, const Vec3d& period, const std::array<int, 3>& count) {
  detail::requireField("repeat operand", field);
  std::array<AxisRepeat, 3> axes;
  for (int i = 0; i < 3; ++i) {
    detail::requireNotNegative("repeat period", period[i]);
    if (count[i] < 0) throw std::invalid_argument("repeat count must not be negative, not " + std::to_string(count[i]));
    axes[i] = {period[i], count[i] > 0 ? count[i] : std::numeric_limits<double>::infinity()};
  }
  return std::make_shared<RepeatedField>(std::move(field), axes);
}

}  // namespace pdc
