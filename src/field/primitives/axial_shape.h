#pragma once

#include "field/interval_arithmetic.h"
#include "field/pointwise_field.h"
#include "field/primitives/convex_bound.h"

namespace pdc::detail {

/// The value and derivatives of a function of the distance `rho` from an axis and the position `z` along it.
struct AxialGradient {
  double value, dRho, dZ;
};

/// A solid of revolution about the line through `origin` along the unit vector `axis`. Profile is an exact signed
/// distance in the half-plane rho >= 0, with
///   double value(double rho, double z) const;
///   AxialGradient gradient(double rho, double z) const;   // the same value, bit for bit
///   double size() const;                                  // largest number in it
/// and, if it is not convex, Interval range(Interval rho, Interval z) const.
template <typename Profile>
struct AxialShape {
  Profile profile;
  Vec3d origin, axis;

  [[nodiscard]] double value(const Vec3d& p) const {
    const Vec3d d = p - origin;
    const double z = dot(axis, d);
    return profile.value(length(d - axis * z), z);
  }

  [[nodiscard]] ValueGradient gradient(const Vec3d& p) const {
    const Vec3d d = p - origin;
    const double z = dot(axis, d);
    const Vec3d away = d - axis * z;
    const double rho = length(away);
    const AxialGradient f = profile.gradient(rho, z);
    // On the axis there is no direction away from it: that part of the gradient is left out.
    return {f.value, axis * f.dZ + away * (rho > 0 ? f.dRho / rho : 0.0)};
  }

  [[nodiscard]] Interval bound(const Box& box) const {
    const double magnitude = size() + largestEntry(box);
    if constexpr (requires(Interval i) { profile.range(i, i); }) {
      const Interval rho = convexBound(AxisDistance{origin, axis}, box);
      const Interval z = around(dot(axis, box.center() - origin), extent(box, axis));
      const Interval byDistance = around(value(box.center()), box.radius());
      return widened(intersection(byDistance, profile.range({std::max(rho.lo, 0.0), rho.hi}, z)), magnitude);
    } else {
      return widened(convexBound(*this, box), magnitude);
    }
  }

  [[nodiscard]] double lipschitz() const { return 1; }
  [[nodiscard]] double size() const { return largestEntry(origin) + profile.size(); }

 private:
  struct AxisDistance {
    Vec3d origin, axis;

    [[nodiscard]] double value(const Vec3d& p) const { return gradient(p).value; }
    [[nodiscard]] ValueGradient gradient(const Vec3d& p) const {
      const Vec3d d = p - origin;
      const Vec3d away = d - axis * dot(axis, d);
      const double rho = length(away);
      return {rho, rho > 0 ? away * (1 / rho) : Vec3d{}};
    }
  };
};

}  // namespace pdc::detail
