#pragma once

#include <array>
#include <vector>

#include "pdc/field/field.h"
#include "pdc/math/mat3.h"

/// Combinations of fields. They share ownership of their operands, which stay as they are; lengths are in world units.
///
/// \throws std::invalid_argument, from every function, for null operands, empty lists, vectors and numbers that are not
/// finite, and whatever else is named below.
///
/// Bounds follow from the operands' bounds, and Lipschitz constants are the largest of the operands' unless said
/// otherwise. Distances are kept only where it is said: Boolean operations of distances have the right zero set and
/// never overestimate the distance, but may underestimate it.
namespace pdc {

/// Union: min. Intersection: max. -0.0 is less than +0.0; see isInside(). Gradients are those of the active operand,
/// the first of equals. Where an operand is NaN it counts as outside: the union takes the others, the intersection is
/// NaN.
FieldPtr unite(std::vector<FieldPtr> operands);
FieldPtr intersect(std::vector<FieldPtr> operands);
/// The first operand without all the others: max(a, -b, -c, …). Where b is NaN nothing is taken away; where a is NaN
/// the result is NaN.
FieldPtr subtract(std::vector<FieldPtr> operands);

/// Boolean operations with a fillet: polynomial smooth minimum (quadratic), min(a, b) - h²/(4 radius) with h = max(0,
/// radius - |a - b|), and its counterparts. Values are those of the sharp operation wherever operands differ by
/// `radius` or more, and within radius/4 of them elsewhere. Operands are combined from the first to the last, so with
/// three or more their order matters. radius > 0.
FieldPtr smoothUnite(std::vector<FieldPtr> operands, double radius);
FieldPtr smoothIntersect(std::vector<FieldPtr> operands, double radius);
FieldPtr smoothSubtract(std::vector<FieldPtr> operands, double radius);

/// -f: swaps inside and outside.
FieldPtr complement(FieldPtr field);
/// f - distance: grows (or with a negative distance shrinks) the solid by that length if f is a distance. The new solid
/// holds its boundary.
FieldPtr offset(FieldPtr field, double distance);
/// |f| - thickness / 2: the skin about the zero set, `thickness` wide if f is a distance. It holds its boundary.
/// thickness > 0.
FieldPtr shell(FieldPtr field, double thickness);

/// f(p - by). Keeps distances; translations, rotations and scales that follow each other are merged into one map.
FieldPtr translate(FieldPtr field, const Vec3d& by);
/// The rotation matrix about `axis`, which is normalised and must not be zero, by any number of `degrees`,
/// right-handed: exact for multiples of 90 degrees about coordinate axes.
Mat3d rotation(const Vec3d& axis, double degrees);
/// Rotation about the origin, as rotation() has it. Keeps distances.
FieldPtr rotate(FieldPtr field, const Vec3d& axis, double degrees);
/// Uniform scale about the origin, factor > 0: factor · f(p / factor). Keeps distances.
FieldPtr scale(FieldPtr field, double factor);
/// Non-uniform scale about the origin, factors > 0. The value is multiplied by the smallest factor, so that it never
/// overestimates a distance that f does not overestimate.
FieldPtr scale(FieldPtr field, const Vec3d& factors);
/// Reflects the half x >= 0 (or y, z: `axis` 0, 1, 2; others throw) onto the other half: f(|x|, y, z).
FieldPtr mirror(FieldPtr field, int axis);
/// Copies at multiples of `period`, which is >= 0 along each axis; 0 stands for no copies along it. Space is folded
/// into the cell [-period/2, period/2] about the origin, in which the original should lie: then the zero set is right,
/// but values may overestimate the distance to a neighbouring copy. Where the original does not fit, the function may
/// jump at the cells' borders. `count` >= 0 limits the copies in each direction from the original, 0 does not limit
/// them; beyond the last copy its function goes on. No Lipschitz constant is known.
FieldPtr repeat(FieldPtr field, const Vec3d& period, const std::array<int, 3>& count);

}  // namespace pdc
