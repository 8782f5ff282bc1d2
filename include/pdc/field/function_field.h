#pragma once

#include <functional>
#include <optional>

#include "pdc/field/field.h"

namespace pdc {

/// What a caller knows about its own function. Everything but `value` may be left out.
///
/// The functions are called from many threads at once, also at points somewhat outside of the box that is sampled. They
/// must depend on the point alone. What they throw passes through to whoever evaluates the field.
struct FunctionFieldOptions {
  std::function<double(const Vec3d&)> value;      ///< Negative inside; NaN where there is no value.
  std::function<Vec3d(const Vec3d&)> gradient{};  ///< In value per world unit; without it, central differences.
  std::optional<double> lipschitz{};              ///< |f(p) - f(q)| <= lipschitz |p - q|, > 0; 1 for a distance.
};

/// A field from a C++ callable.
///
/// Without a gradient function each gradient takes six more values, at a step of 6e-6 times the largest coordinate, at
/// least 6e-9. The Lipschitz constant is not checked: parts of the surface are lost where it does not hold. Without one
/// bound() knows nothing and the sampler falls back to a coarse lattice, which can miss parts smaller than that
/// lattice. \throws std::invalid_argument without a value function, or with a Lipschitz constant that is not positive
/// and finite.
FieldPtr functionField(FunctionFieldOptions options);

}  // namespace pdc
