#pragma once

#include "pdc/math/mat3.h"
#include "pdc/math/sym_mat3.h"

/// Error quadrics f(x) = xᵀAx − 2bᵀx + c (Trettner & Kobbelt 2020, equation 1), and those of points and planes.
///
/// Coordinates are the caller's, and b and c grow with the distance from their origin: build quadrics in a local frame
/// (origin near the data, unit its size), where single precision loses nothing. All functions are pure: they throw
/// nothing, and NaN and infinities pass through them. This header needs only the standard library.
namespace pdc {

/// The part of a quadric that says where its minimum is, Ax = b, without the constant that says how deep it is.
template <typename T>
struct NormalEquations {
  SymMat3<T> A;
  Vec3<T> b;

  static constexpr NormalEquations zero() { return {SymMat3<T>::zero(), Vec3<T>{}}; }

  constexpr NormalEquations& operator+=(const NormalEquations& o) { return *this = *this + o; }
  friend constexpr NormalEquations operator+(const NormalEquations& p, const NormalEquations& q) {
    return {p.A + q.A, p.b + q.b};
  }
};

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
  /// A and b alone. If nothing else of a factory's result is used, compilers leave out the work for c.
  [[nodiscard]] constexpr NormalEquations<T> normalEquations() const { return {A, b}; }

  /// The same function seen from another origin: y ↦ f(y + origin).
  [[nodiscard]] constexpr Quadric relativeTo(const Vec3<T>& origin) const {
    return {A, b - A * origin, (*this)(origin)};
  }
  /// y ↦ f(My + t). To move a quadric along with its geometry, x ↦ Mx + t, pull it back through the inverse map.
  [[nodiscard]] constexpr Quadric pullback(const Mat3<T>& M, const Vec3<T>& t) const {
    return {congruence(A, M), M.transposed() * (b - A * t), (*this)(t)};
  }

  constexpr Quadric& operator+=(const Quadric& o) { return *this = *this + o; }
  constexpr Quadric& operator-=(const Quadric& o) { return *this = *this - o; }
  constexpr Quadric& operator*=(T s) { return *this = *this * s; }
  friend constexpr Quadric operator+(const Quadric& p, const Quadric& q) { return {p.A + q.A, p.b + q.b, p.c + q.c}; }
  /// A difference of quadrics need not have a minimum.
  friend constexpr Quadric operator-(const Quadric& p, const Quadric& q) { return {p.A - q.A, p.b - q.b, p.c - q.c}; }
  friend constexpr Quadric operator*(const Quadric& q, T s) { return {q.A * s, q.b * s, q.c * s}; }
  friend constexpr Quadric operator*(T s, const Quadric& q) { return q * s; }
  friend constexpr bool operator==(const Quadric&, const Quadric&) = default;
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

/// Expected squared distance to a plane whose normal is distributed as N(n, Sigma_n) (equations 6-8 with Σq = 0).
/// Positive definite whenever Sigma_n is; whether Sigma_n is a covariance is not checked.
template <typename T>
constexpr Quadric<T> probabilisticPlaneQuadric(const Vec3<T>& q, const Vec3<T>& n, const SymMat3<T>& Sigma_n) {
  const T d = dot(n, q);
  const Vec3<T> s = Sigma_n * q;
  return {outer(n) + Sigma_n, n * d + s, d * d + dot(q, s)};
}

/// Expected squared distance to a plane whose normal is distributed as N(n, Sigma_n) and whose point, independently, as
/// N(q, Sigma_q) (equations 6-8). Sigma_q adds nᵀΣq n + Tr[Σn Σq] to the constant and does not move the minimum.
template <typename T>
constexpr Quadric<T> probabilisticPlaneQuadric(const Vec3<T>& q, const Vec3<T>& n, const SymMat3<T>& Sigma_n,
                                               const SymMat3<T>& Sigma_q) {
  Quadric<T> f = probabilisticPlaneQuadric(q, n, Sigma_n);
  f.c += quadraticForm(Sigma_q, n) + traceOfProduct(Sigma_n, Sigma_q);
  return f;
}

/// Expected squared distance for isotropic noise, Sigma_n = sigmaNormal² I and Sigma_q = sigmaPosition² I. Signs of the
/// standard deviations do not matter.
/// \param sigmaNormal standard deviation of the normal along each axis; it has the unit of n, mostly none.
/// \param sigmaPosition standard deviation of the point along each axis, in the unit of q.
template <typename T>
constexpr Quadric<T> probabilisticPlaneQuadric(const Vec3<T>& q, const Vec3<T>& n, T sigmaNormal,
                                               T sigmaPosition = T(0)) {
  const T d = dot(n, q), sn = sigmaNormal * sigmaNormal, sq = sigmaPosition * sigmaPosition;
  return {outer(n).plusDiagonal(sn), n * d + q * sn, d * d + sn * dot(q, q) + sq * (dot(n, n) + 3 * sn)};
}

/// Σ wᵢ (x − pᵢ)ᵀΣn(x − pᵢ): what noise of the normals, with one covariance Sigma_n for all, adds to a sum of planes
/// through pᵢ with weights wᵢ. Σ wᵢ planeQuadric(pᵢ, nᵢ) and this are Σ wᵢ probabilisticPlaneQuadric(pᵢ, nᵢ, Sigma_n).
/// \param weight Σ wᵢ. \param points Σ wᵢ pᵢ. \param squares Σ wᵢ pᵢᵀΣn pᵢ.
template <typename T>
constexpr Quadric<T> normalNoiseQuadric(const SymMat3<T>& Sigma_n, T weight, const Vec3<T>& points, T squares) {
  return {Sigma_n * weight, Sigma_n * points, squares};
}

/// Σn = σ²(I − nnᵀ): a unit normal that is uncertain in its direction only, not in its length. It is singular, but a
/// plane quadric with it is not: nnᵀ + Σn is positive definite for sigmaNormal > 0.
template <typename T>
constexpr SymMat3<T> tangentialCovariance(const Vec3<T>& n, T sigmaNormal) {
  return (SymMat3<T>::identity() - outer(n)) * (sigmaNormal * sigmaNormal);
}

}  // namespace pdc
