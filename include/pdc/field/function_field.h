#pragma once

#include <functional>
#include <optional>

#include "pdc/field/field.h"

namespace pdc {

/// What a caller knows about its own function. Everything but `value` may be left out.
struct FunctionFieldOptions {
  std::function<double(const Vec3d&)> value;      ///< Negative inside. Called from many threads.
  std::function<Vec3d(const Vec3d&)> gradient{};  ///< Without it, central differences.
  std::optional<double> lipschitz{};              ///< |f(p) - f(q)| <= lipschitz |p - q|; 1 for a distance function.
};

/// A field from a C++ callable.
/// \throws std::invalid_argument without a value function or with a lipschitz constant that is not positive.
FieldPtr functionField(FunctionFieldOptions options);

}  // namespace pdc
