#pragma once

#include "pdc/field/field.h"

/// Implicit shapes: negative inside, exact gradients, in world units. Unless said otherwise the value is the exact
/// signed distance, and bound() uses that it changes by at most one per unit length. Sizes must be positive and finite;
/// anything else throws std::invalid_argument.
namespace pdc {

FieldPtr sphere(const Vec3d& center, double radius);

/// Axis-aligned box by its centre and half edge lengths.
FieldPtr box(const Vec3d& center, const Vec3d& halfSize);

/// A box whose edges and corners are rounded; `halfSize` is the outer size, `radius` at most its smallest entry.
FieldPtr roundedBox(const Vec3d& center, const Vec3d& halfSize, double radius);

/// Half-space {x : (x - point)·normal < 0}. The normal is normalised; it must not be zero.
FieldPtr plane(const Vec3d& point, const Vec3d& normal);

/// Solid cylinder with flat ends between two points.
FieldPtr cylinder(const Vec3d& from, const Vec3d& to, double radius);

/// Cone frustum with flat ends; one of the radii may be zero.
FieldPtr cappedCone(const Vec3d& from, const Vec3d& to, double radiusFrom, double radiusTo);

/// Torus about `axis` (normalised): `radius` from the centre to the tube's axis, `tube` the tube's radius. With tube >
/// radius it closes about the centre, and values inside are no more than the distance.
FieldPtr torus(const Vec3d& center, const Vec3d& axis, double radius, double tube);

/// All points within `radius` of the segment.
FieldPtr capsule(const Vec3d& from, const Vec3d& to, double radius);

/// Ellipsoid by its semi-axes. The value is a first-order distance k0 (k0 - 1) / k1 with k0 = |p/r|, k1 = |p/r²|: exact
/// zero set and normals, not a distance away from it.
FieldPtr ellipsoid(const Vec3d& center, const Vec3d& semiAxes);

/// Gyroid sheet solid: |sin x cos y + sin y cos z + sin z cos x| < thickness with x scaled by 2π/period. thickness 0
/// takes the solid on the negative side of the gyroid. The value is not a distance; it is scaled to have about unit
/// slope.
FieldPtr gyroid(double period, double thickness);

}  // namespace pdc
