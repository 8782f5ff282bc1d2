#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include "pdc/math/box.h"
#include "pdc/math/interval.h"

namespace pdc {

/// Points to evaluate, in world units, one array per coordinate. size <= Field::kMaxBatch; coordinates are finite.
/// Neither is checked.
struct PointSpan {
  const double* x;
  const double* y;
  const double* z;
  std::size_t size;
};

/// Where gradients go, one array per component, as long as the points' and apart from them.
struct GradientSpan {
  double* x;
  double* y;
  double* z;
};

/// Whether a value of a field is inside: below zero, or -0.0. NaN and +0.0 are outside.
[[nodiscard]] inline bool isInside(double value) { return value <= 0 && std::signbit(value); }

/// A scalar function of space; negative inside. The sign of a zero says whether the boundary belongs to the solid: it
/// does for primitives, which are -0.0 there, does not for their complements, and operators pass it on, so that solids
/// that touch unite without a gap, and a cut flush with a face leaves nothing of it. Formulas, functions, grids and
/// noise are +0.0 wherever they are zero. Immutable and safe to evaluate from many threads at once.
///
/// Work is done in batches, so that the cost of a virtual call is shared and the loops inside vectorise. The result for
/// a point must not depend on the other points of its batch: neighbouring blocks evaluate shared lattice points
/// separately and must agree.
///
/// Fields of fields evaluate their operands recursively, with about 8 KiB of stack for each level.
class Field {
 public:
  /// Largest batch; implementations keep their temporaries in arrays of this length on the stack.
  static constexpr std::size_t kMaxBatch = 256;

  virtual ~Field() = default;

  /// values[i] = f(p_i). NaN is allowed where the function has no value; the sampler refuses it, or reads it as outside
  /// where that is asked for, as it does infinite values. The array is as long as the points' and apart from them.
  virtual void values(PointSpan points, double* values) const = 0;

  /// Fills the values that values() gives, bit for bit, and the gradient at each point, in value per world unit. On a
  /// crease it is the gradient of one of the pieces that meet there; where the function has none it is zero or NaN,
  /// which the sampler treats as "no normal".
  virtual void gradients(PointSpan points, double* values, GradientSpan gradients) const = 0;

  /// A range that contains f over the whole box (closed, lo <= hi), but for places where f is NaN; rounding is
  /// included. Interval::whole() if nothing is known, which costs the sampler its pruning there, never correctness.
  [[nodiscard]] virtual Interval bound(const Box& box) const = 0;

  /// A constant L with |f(p) - f(q)| <= L |p - q| everywhere, infinity if none is known. It keeps bounds tight where
  /// boxes are turned.
  [[nodiscard]] virtual double lipschitz() const { return std::numeric_limits<double>::infinity(); }

  /// How many shapes the field is made of, as far as simplified() can leave some out; 1 if it cannot.
  [[nodiscard]] virtual std::size_t parts() const { return 1; }

  /// A field with the same values and gradients as this one, bit for bit, at every point of the box, that costs less
  /// there; null if there is none. Its bound() and lipschitz() hold within the box. It shares ownership of what it
  /// needs.
  ///
  /// Boolean operations leave out the operands whose bounds over the box say that they decide nothing in it: M. J.
  /// Keeter, Massively Parallel Rendering of Complex Closed-Form Implicit Surfaces, ACM Transactions on Graphics 39(4),
  /// 2020.
  [[nodiscard]] virtual std::shared_ptr<const Field> simplified(const Box& /*box*/) const { return nullptr; }

  /// Whether it is known that neither f nor any field that it is made of is NaN in the box, so that bound() holds
  /// everywhere in it; false if nothing is known. Others are not left out.
  [[nodiscard]] virtual bool definedIn(const Box& /*box*/) const { return false; }

  /// The value at one point, as values() gives it; for tests and occasional use.
  [[nodiscard]] double valueAt(const Vec3d& p) const;
  /// The gradient at one point, as gradients() gives it; for tests and occasional use.
  [[nodiscard]] Vec3d gradientAt(const Vec3d& p) const;
};

using FieldPtr = std::shared_ptr<const Field>;

}  // namespace pdc
