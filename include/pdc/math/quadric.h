#pragma once

#include "pdc/math/sym_mat3.h"

/// Error quadrics f(x) = xᵀAx − 2bᵀx + c (Trettner & Kobbelt 2020, equation 1). Coordinates are the caller's: build quadrics
/// in a local frame (origin near the data, unit its size), where single precision loses nothing.
namespace pdc {

/// A plain value of ten scalars. Sums of quadrics measure sums of errors (equation 3).
template <typename T>
struct Quadric {
  SymMat3<T> A;
  Vec3<T> b;
  T c;

  static constexpr Quadric zero() { return {SymMat3<T>::zero(), Vec3<T>{}, T(0)}; }

  /// f(x).
  [[nodiscard]] constexpr T operator()(const Vec3<T>& x) const { return dot(x, A * x) - 2 * dot(b, x) + c; }
  /// Half the gradient of f, Ax − b.
  [[nodiscard]] constexpr Vec3<T> halfGradient(const Vec3<T>& x) const { return A * x - b; }

  constexpr Quadric& operator+=(const Quadric& o) { return *this = *this + o; }
  friend constexpr Quadric operator+(const Quadric& p, const Quadric& q) { return {p.A + q.A, p.b + q.b, p.c + q.c}; }
  friend constexpr Quadric operator*(const Quadric& q, T s) { return {q.A * s, q.b * s, q.c * s}; }
};

/// |x − q|²: the quadric a plane quadric becomes when nothing is known of its normal.
template <typename T>
constexpr Quadric<T> pointQuadric(const Vec3<T>& q) {
  return {SymMat3<T>::identity(), q, dot(q, q)};
}

/// Squared distance to the plane through q with unit normal n (equation 4). A normal of length l weighs it by l².
template <typename T>
constexpr Quadric<T> planeQuadric(const Vec3<T>& q, const Vec3<T>& n) {
  const T d = dot(n, q);
  return {outer(n), n * d, d * d};
}

/// Expected squared distance to a plane whose normal is distributed as N(n, Sigma_n) (equations 6-8 with Σq = 0; Σq would
/// only add a constant). Positive definite whenever Sigma_n is.
template <typename T>
constexpr Quadric<T> probabilisticPlaneQuadric(const Vec3<T>& q, const Vec3<T>& n, const SymMat3<T>& Sigma_n) {
  const T d = dot(n, q);
  const Vec3<T> s = Sigma_n * q;
  return {outer(n) + Sigma_n, n * d + s, d * d + dot(q, s)};
}

/// The isotropic case, Sigma_n = sigmaNormal² I.
template <typename T>
constexpr Quadric<T> probabilisticPlaneQuadric(const Vec3<T>& q, const Vec3<T>& n, T sigmaNormal) {
  return probabilisticPlaneQuadric(q, n, SymMat3<T>::identity() * (sigmaNormal * sigmaNormal));
}

}  // namespace pdc
