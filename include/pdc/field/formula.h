#pragma once

#include <optional>
#include <string>

#include "pdc/field/field.h"

namespace pdc {

/// The value of a formula in x, y and z in world units, negative inside: muParser's syntax and functions, `pi`, and
/// floor(a), ceil(a), round(a) (halves away from zero) and mod(a, b) = a - b floor(a / b). At most 19999 characters.
///
/// A jump, as floor() has it, that changes sign makes a surface across which there is no gradient: its normals come
/// from the functions on either side.
///
/// Gradients are central differences at a step of 6e-6 times the largest coordinate, at least 6e-9, so creases are
/// blurred over about that length; each costs six more evaluations. The formula is interpreted point by point, by a
/// parser per thread that lives as long as the field. It may be NaN in places, as sqrt(x) is for x < 0.
///
/// `lipschitz`, if given, promises |f(p) - f(q)| <= lipschitz · |p - q| and lets the sampler prune; the promise is not
/// checked, and parts of the surface are lost where it does not hold. Without it bound() knows nothing and the sampler
/// falls back to a coarse lattice, which can miss parts smaller than that lattice.
/// \throws Error with the position, in characters from 0, if the formula does not parse, is too long, has not exactly
/// one value, or is a constant that is not finite; std::invalid_argument if lipschitz is not positive and finite.
FieldPtr formula(const std::string& expression, std::optional<double> lipschitz = std::nullopt);

}  // namespace pdc
