#pragma once

#include "pdc/field/field.h"

/// Checks of a caller's arguments. All throw std::invalid_argument with one line that says what, the limit and the
/// value.
namespace pdc::detail {

void requirePositive(const char* what, double value);
void requirePositive(const char* what, const Vec3d& value);
void requireNotNegative(const char* what, double value);
void requireFinite(const char* what, double value);
void requireFinite(const char* what, const Vec3d& value);
/// \returns the normalised direction.
Vec3d requireDirection(const char* what, const Vec3d& value);
void requireField(const char* what, const FieldPtr& field);

}  // namespace pdc::detail
