#pragma once

#include <array>
#include <vector>

#include "pdc/field/field.h"
#include "pdc/math/mat3.h"

/// Combinations of fields. Null arguments and empty lists throw std::invalid_argument.
namespace pdc {

/// min, max, and max(a, -b): sharp Boolean operations. Gradients are those of the active operand.
FieldPtr unite(std::vector<FieldPtr> operands);
FieldPtr intersect(std::vector<FieldPtr> operands);
/// The first operand without all the others.
FieldPtr subtract(std::vector<FieldPtr> operands);

/// Boolean operations with a fillet about `radius` wide (world units, > 0): polynomial smooth minimum (quadratic),
/// applied from the first operand to the last.
FieldPtr smoothUnite(std::vector<FieldPtr> operands, double radius);
FieldPtr smoothIntersect(std::vector<FieldPtr> operands, double radius);
FieldPtr smoothSubtract(std::vector<FieldPtr> operands, double radius);

/// -f: swaps inside and outside.
FieldPtr complement(FieldPtr field);
/// f - distance: grows (or with a negative distance shrinks) a distance field.
FieldPtr offset(FieldPtr field, double distance);
/// |f| - thickness / 2: the skin about the zero set, `thickness` wide.
FieldPtr shell(FieldPtr field, double thickness);

FieldPtr translate(FieldPtr field, const Vec3d& by);
/// Rotation matrix about `axis` (normalised) by `degrees`, right-handed.
Mat3d rotation(const Vec3d& axis, double degrees);
/// Rotation about the origin.
FieldPtr rotate(FieldPtr field, const Vec3d& axis, double degrees);
/// Uniform scale about the origin, factor > 0. Keeps distances distances.
FieldPtr scale(FieldPtr field, double factor);
/// Non-uniform scale about the origin, factors > 0; the value is multiplied by the smallest factor, so it never
/// overestimates a distance.
FieldPtr scale(FieldPtr field, const Vec3d& factors);
/// Reflects the half x >= 0 (or y, z: `axis` 0, 1, 2) onto the other half: f(|x|, y, z).
FieldPtr mirror(FieldPtr field, int axis);
/// Copies with the given period along each axis, 0 for none, the cell about the origin taken as the original. `count`
/// limits the copies on each side of the original (0 = without limit). The zero set is right if the original fits into
/// its cell.
FieldPtr repeat(FieldPtr field, const Vec3d& period, const std::array<int, 3>& count);

}  // namespace pdc
