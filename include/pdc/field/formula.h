#pragma once

#include <optional>
#include <string>

#include "pdc/field/field.h"

namespace pdc {

/// A formula in x, y and z (muParser syntax, plus `pi`), negative inside. Gradients are central differences, so creases
/// are blurred over about 1e-5 of the coordinates' size.
///
/// `lipschitz`, if given, promises |f(p) - f(q)| <= lipschitz · |p - q| and lets the sampler prune; without it bound()
/// knows nothing and the sampler falls back to a coarse lattice, which can miss parts smaller than that lattice.
/// \throws Error with the position if the formula does not parse, std::invalid_argument if lipschitz is not positive.
FieldPtr formula(const std::string& expression, std::optional<double> lipschitz = std::nullopt);

}  // namespace pdc
