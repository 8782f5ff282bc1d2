#pragma once

#include "pdc/field/field.h"

/// Implicit shapes in world units: negative inside, -0.0 on the boundary, up to the rounding of numbers as large as the
/// shape's (see isInside()), exact gradients. Unless said otherwise the value is the exact
/// signed distance and the Lipschitz constant is 1. Where a distance has no gradient, as on a solid's axis, there is a
/// finite one nevertheless.
///
/// \throws std::invalid_argument, from every function, for sizes that are not positive and finite, unless zero is
/// allowed, for points that are not finite, and for directions that are zero or not finite.
namespace pdc {

/// The ball of `radius` about `center`.
FieldPtr sphere(const Vec3d& center, double radius);

/// Axis-aligned box by its centre and half edge lengths.
FieldPtr box(const Vec3d& center, const Vec3d& halfSize);

/// A box whose edges and corners are rounded; `halfSize` is the outer size, `radius` at most its smallest entry.
FieldPtr roundedBox(const Vec3d& center, const Vec3d& halfSize, double radius);

/// The half-space {x : (x - point)·normal < 0}. The normal is normalised.
FieldPtr plane(const Vec3d& point, const Vec3d& normal);

/// Solid cylinder with flat ends between two different points.
FieldPtr cylinder(const Vec3d& from, const Vec3d& to, double radius);

/// Cone frustum with flat ends at two different points; one of the radii may be zero.
FieldPtr cappedCone(const Vec3d& from, const Vec3d& to, double radiusFrom, double radiusTo);

/// Torus about `axis` (normalised): `radius` from the centre to the tube's axis, `tube` the tube's radius. With tube >
/// radius it closes about the centre, and values inside are no more than the distance.
FieldPtr torus(const Vec3d& center, const Vec3d& axis, double radius, double tube);

/// All points within `radius` of the segment between two different points.
FieldPtr capsule(const Vec3d& from, const Vec3d& to, double radius);

/// Ellipsoid by its semi-axes. The value is a first-order distance k0 (k0 - 1) / k1 with k0 = |p/r|, k1 = |p/r²|: exact
/// zero set and normals, not a distance away from it. No Lipschitz constant is known.
FieldPtr ellipsoid(const Vec3d& center, const Vec3d& semiAxes);

/// Gyroid sheet: |sin x cos y + sin y cos z + sin z cos x| < thickness with x, y, z scaled by 2π/period; the sum lies
/// in
/// [-1.5, 1.5]. thickness 0 takes the solid where the sum is negative. The value is not a distance, but scaled so that
/// its slope is at most 1. On the boundary it is +0.0.
FieldPtr gyroid(double period, double thickness);

}  // namespace pdc
