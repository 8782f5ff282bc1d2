#pragma once

#include <cmath>

#include "pdc/math/vec3.h"

namespace pdc {

// Signs of determinants of coordinates, decided exactly: a floating-point filter answers almost always, and expansion
// arithmetic (Shewchuk 1997, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates) the
// rest.
//
// Exact for finite coordinates that are zero or multiples of 2^-300 and not above 2^300, so for all finite single
// precision numbers; beyond that products may overflow or underflow. NaN and infinities give any sign. The functions
// neither allocate nor throw. They need round-to-nearest without flushing of denormals, and a compiler that keeps to
// IEEE arithmetic (no -ffast-math); fused multiply-adds do no harm here.

namespace detail {

int orient3dExactly(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);
int orient2dExactly(double ax, double ay, double bx, double by, double cx, double cy);

inline constexpr double kHalfUlp = 0x1p-53;
/// The filters' relative errors, Shewchuk's bounds "A" of orient3d and orient2d.
inline constexpr double kOrient3dError = (7 + 56 * kHalfUlp) * kHalfUlp;
inline constexpr double kOrient2dError = (3 + 16 * kHalfUlp) * kHalfUlp;

inline int orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const double left = (bx - ax) * (cy - ay), right = (by - ay) * (cx - ax);
  const double det = left - right;
  const double error = kOrient2dError * (std::abs(left) + std::abs(right));
  if (det > error) return 1;
  if (-det > error) return -1;
  return error == 0 ? 0 : orient2dExactly(ax, ay, bx, by, cx, cy);
}

}  // namespace detail

/// The sign, -1, 0 or 1, of dot(cross(b - a, c - a), d - a): on which side of the plane through a, b and c the point d
/// is. Positive is the side from which a, b, c is counter-clockwise; 0 means coplanar.
[[nodiscard]] inline int orient3d(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const Vec3d u = b - a, v = c - a, w = d - a;
  const double uyvz = u.y * v.z, uzvy = u.z * v.y;
  const double uzvx = u.z * v.x, uxvz = u.x * v.z;
  const double uxvy = u.x * v.y, uyvx = u.y * v.x;
  const double det = w.x * (uyvz - uzvy) + w.y * (uzvx - uxvz) + w.z * (uxvy - uyvx);
  const double size = std::abs(w.x) * (std::abs(uyvz) + std::abs(uzvy)) +
                      std::abs(w.y) * (std::abs(uzvx) + std::abs(uxvz)) +
                      std::abs(w.z) * (std::abs(uxvy) + std::abs(uyvx));
  const double error = detail::kOrient3dError * size;
  if (det > error) return 1;
  if (-det > error) return -1;
  return error == 0 ? 0 : detail::orient3dExactly(a, b, c, d);
}

[[nodiscard]] inline int orient3d(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d) {
  return orient3d(vecCast<double>(a), vecCast<double>(b), vecCast<double>(c), vecCast<double>(d));
}

/// The sign of cross(b - a, c - a)[axis], axis 0 to 2: which way a, b, c turn, seen from the axis's positive end.
[[nodiscard]] inline int orient2d(const Vec3d& a, const Vec3d& b, const Vec3d& c, int axis) {
  const int x = axis == 2 ? 0 : axis + 1, y = axis == 0 ? 2 : axis - 1;
  return detail::orient2d(a[x], a[y], b[x], b[y], c[x], c[y]);
}

[[nodiscard]] inline int orient2d(const Vec3f& a, const Vec3f& b, const Vec3f& c, int axis) {
  return orient2d(vecCast<double>(a), vecCast<double>(b), vecCast<double>(c), axis);
}

/// Whether the three points lie on one line, decided exactly; also true where two of them coincide.
template <typename T>
[[nodiscard]] bool collinear(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c) {
  return orient2d(a, b, c, 0) == 0 && orient2d(a, b, c, 1) == 0 && orient2d(a, b, c, 2) == 0;
}

}  // namespace pdc
