#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "field/arguments.h"
#include "field/primitives/axial_shape.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

using detail::AxialGradient;

double norm(double x, double y) { return std::sqrt(x * x + y * y); }

struct CylinderProfile {
  double radius, halfLength;

  [[nodiscard]] double value(double rho, double z) const {
    const double lateral = rho - radius, cap = std::abs(z) - halfLength;
    return norm(std::max(lateral, 0.0), std::max(cap, 0.0)) + std::min(std::max(lateral, cap), 0.0);
  }
  [[nodiscard]] AxialGradient gradient(double rho, double z) const {
    const double lateral = std::max(rho - radius, 0.0), cap = std::max(std::abs(z) - halfLength, 0.0);
    const double distance = norm(lateral, cap), up = z < 0 ? -1 : 1, f = value(rho, z);
    if (distance > 0) return {f, lateral / distance, up * cap / distance};
    return rho - radius >= std::abs(z) - halfLength ? AxialGradient{f, 1, 0} : AxialGradient{f, 0, up};
  }
  [[nodiscard]] double size() const { return std::max(radius, halfLength); }
};

struct CapsuleProfile {
  double radius, halfLength;

  [[nodiscard]] double value(double rho, double z) const {
    return norm(rho, std::max(std::abs(z) - halfLength, 0.0)) - radius;
  }
  [[nodiscard]] AxialGradient gradient(double rho, double z) const {
    const double beyond = std::max(std::abs(z) - halfLength, 0.0), distance = norm(rho, beyond);
    const double inverse = distance > 0 ? 1 / distance : 0;
    return {distance - radius, rho * inverse, (z < 0 ? -beyond : beyond) * inverse};
  }
  [[nodiscard]] double size() const { return std::max(radius, halfLength); }
};

struct TorusProfile {
  double radius, tube;

  [[nodiscard]] double value(double rho, double z) const { return norm(rho - radius, z) - tube; }
  [[nodiscard]] AxialGradient gradient(double rho, double z) const {
    const double distance = norm(rho - radius, z), inverse = distance > 0 ? 1 / distance : 0;
    return {distance - tube, (rho - radius) * inverse, z * inverse};
  }
  [[nodiscard]] double size() const { return std::max(radius, tube); }
  [[nodiscard]] Interval range(Interval rho, Interval z) const {
    const Interval x = detail::absolute(rho + -radius), y = detail::absolute(z);
    return {norm(x.lo, y.lo) - tube, norm(x.hi, y.hi) - tube};
  }
};

/// A convex polygon in the half-plane rho >= 0: two caps at z = ±halfLength, and a lateral line between their rims.
struct ConeProfile {
  double lowerRadius, upperRadius, halfLength;
  double lateralRho, lateralZ, lateralLength;  ///< The unit tangent of the lateral line, upwards, and its length.

  ConeProfile(double lower, double upper, double half) : lowerRadius(lower), upperRadius(upper), halfLength(half) {
    lateralLength = norm(upper - lower, 2 * half);
    lateralRho = (upper - lower) / lateralLength;
    lateralZ = 2 * half / lateralLength;
  }

  [[nodiscard]] double value(double rho, double z) const { return gradient(rho, z).value; }
  [[nodiscard]] AxialGradient gradient(double rho, double z) const {
    const double dRho = rho - lowerRadius, dZ = z + halfLength;
    const double lateral = dRho * lateralZ - dZ * lateralRho, along = dRho * lateralRho + dZ * lateralZ;
    const double cap = std::abs(z) - halfLength, up = z < 0 ? -1 : 1;
    const AxialGradient onLateral{lateral, lateralZ, -lateralRho}, onCap{cap, 0, up};
    if (std::max(lateral, cap) <= 0) return lateral >= cap ? onLateral : onCap;
    if (cap > 0 && rho <= (z < 0 ? lowerRadius : upperRadius)) return onCap;
    if (lateral > 0 && along >= 0 && along <= lateralLength) return onLateral;
    const bool upper = along > lateralLength / 2;
    const double x = rho - (upper ? upperRadius : lowerRadius), y = upper ? z - halfLength : z + halfLength;
    const double distance = norm(x, y);
    return distance > 0 ? AxialGradient{distance, x / distance, y / distance} : onLateral;
  }
  [[nodiscard]] double size() const { return std::max({lowerRadius, upperRadius, halfLength}); }
};

struct Axis {
  Vec3d middle, direction;
  double halfLength;
};

Axis axisBetween(const char* what, const Vec3d& from, const Vec3d& to) {
  detail::requireFinite(what, from);
  detail::requireFinite(what, to);
  return {(from + to) * 0.5, detail::requireDirection(what, to - from), length(to - from) / 2};
}

template <typename Profile>
FieldPtr makeAxial(const Profile& profile, const Vec3d& origin, const Vec3d& axis) {
  return detail::makePointwise(detail::AxialShape<Profile>{profile, origin, axis});
}

}  // namespace

FieldPtr cylinder(const Vec3d& from, const Vec3d& to, double radius) {
  const Axis axis = axisBetween("cylinder ends and their difference", from, to);
  detail::requirePositive("cylinder radius", radius);
  return makeAxial(CylinderProfile{radius, axis.halfLength}, axis.middle, axis.direction);
}

FieldPtr cappedCone(const Vec3d& from, const Vec3d& to, double radiusFrom, double radiusTo) {
  const Axis axis = axisBetween("capped cone ends and their difference", from, to);
  detail::requireNotNegative("capped cone radius", radiusFrom);
  detail::requireNotNegative("capped cone radius", radiusTo);
  detail::requirePositive("capped cone larger radius", std::max(radiusFrom, radiusTo));
  return makeAxial(ConeProfile(radiusFrom, radiusTo, axis.halfLength), axis.middle, axis.direction);
}

FieldPtr torus(const Vec3d& center, const Vec3d& axis, double radius, double tube) {
  detail::requireFinite("torus center", center);
  const Vec3d direction = detail::requireDirection("torus axis", axis);
  detail::requirePositive("torus radius", radius);
  detail::requirePositive("torus tube radius", tube);
  return makeAxial(TorusProfile{radius, tube}, center, direction);
}

FieldPtr capsule(const Vec3d& from, const Vec3d& to, double radius) {
  const Axis axis = axisBetween("capsule ends and their difference", from, to);
  detail::requirePositive("capsule radius", radius);
  return makeAxial(CapsuleProfile{radius, axis.halfLength}, axis.middle, axis.direction);
}

}  // namespace pdc
