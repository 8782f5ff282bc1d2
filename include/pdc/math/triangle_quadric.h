#pragma once

#include "pdc/math/quadric.h"

/// Error quadrics of triangles (Trettner & Kobbelt 2020, section 3.2). All weigh by the square of twice the area.
///
/// Corners are relative to the caller's origin, and so is the result: pass p − o, q − o, r − o for a triangle near o.
/// The quadrics are built about p from the differences q − p and r − p, then moved to the origin, so A is exact to
/// rounding at any distance; the sum p×q + q×r + r×p, the same in exact arithmetic, has lost every digit a thousand
/// edges away in single precision. A grows with the fourth, b with the fifth and c with the sixth power of the unit of
/// length.
namespace pdc {

/// The cross-interference matrix Ci[A, B] (equation 12): bilinear, symmetric in A and B, and 2I for A = B = I (equation
/// 13). Ci[eeᵀ, B] = [e]× B [e]×ᵀ, which makes it all that equation 11 is made of.
template <typename T>
constexpr SymMat3<T> crossInterference(const SymMat3<T>& A, const SymMat3<T>& B) {
  return {A.yy * B.zz - 2 * (A.yz * B.yz) + A.zz * B.yy,         A.xz * B.yz - A.xy * B.zz + A.yz * B.xz - A.zz * B.xy,
          A.xy * B.yz - A.xz * B.yy + A.yz * B.xy - A.yy * B.xz, A.xx * B.zz - 2 * (A.xz * B.xz) + A.zz * B.xx,
          A.xy * B.xz - A.xx * B.yz + A.xz * B.xy - A.yz * B.xx, A.xx * B.yy - 2 * (A.xy * B.xy) + A.yy * B.xx};
}

/// Squared distance to the plane of the triangle, times (2 area)² (equation 9). Always of rank one.
template <typename T>
constexpr Quadric<T> triangleQuadric(const Vec3<T>& p, const Vec3<T>& q, const Vec3<T>& r) {
  return planeQuadric(p, cross(q - p, r - p));
}

/// Expectation of triangleQuadric for independent corners distributed as N(p, Sigma_p), N(q, Sigma_q), N(r, Sigma_r)
/// (equations 11, 14 and 15). Positive definite whenever the covariances are, for collinear corners too, though then
/// only by the second-order terms: no single first-order term [e]× Σ [e]×ᵀ is more than semidefinite.
template <typename T>
constexpr Quadric<T> probabilisticTriangleQuadric(const Vec3<T>& p, const Vec3<T>& q, const Vec3<T>& r,
                                                  const SymMat3<T>& Sigma_p, const SymMat3<T>& Sigma_q,
                                                  const SymMat3<T>& Sigma_r) {
  // About p, with u = q − p and v = r − p, every product that holds the mean of p itself is gone.
  const Vec3<T> u = q - p, v = r - p, w = r - q, n = cross(u, v), s = Sigma_p * n;
  const SymMat3<T> Ci_pq = crossInterference(Sigma_p, Sigma_q), Ci_rp = crossInterference(Sigma_r, Sigma_p);
  const Vec3<T> Ci_v = Ci_pq * v, Ci_u = Ci_rp * u;
  const Quadric<T> local{outer(n) + Ci_pq + Ci_rp + crossInterference(outer(w), Sigma_p) +
                             crossInterference(outer(v) + Sigma_r, Sigma_q) + crossInterference(outer(u), Sigma_r),
                         cross(w, s) + Ci_v + Ci_u,
                         dot(n, s) + dot(v, Ci_v) + dot(u, Ci_u) + traceOfProduct(Sigma_r, Ci_pq)};
  return local.relativeTo(-p);
}

/// Isotropic noise of each corner's own standard deviation, in the unit of the corners: equations 11-15 with Σp =
/// sigma_p² I, ….
template <typename T>
constexpr Quadric<T> probabilisticTriangleQuadric(const Vec3<T>& p, const Vec3<T>& q, const Vec3<T>& r, T sigma_p,
                                                  T sigma_q, T sigma_r) {
  const Vec3<T> u = q - p, v = r - p, w = r - q, n = cross(u, v);
  const T sp = sigma_p * sigma_p, sq = sigma_q * sigma_q, sr = sigma_r * sigma_r;
  // Ci[σa² I, σb² I] = 2 σa² σb² I, of which the trace with σc² I is 6 σa² σb² σc².
  const T pq = 2 * (sp * sq), qr = 2 * (sq * sr), rp = 2 * (sr * sp);
  const SymMat3<T> A = outer(n) + crossSquare(u, sr) + crossSquare(v, sq) + crossSquare(w, sp);
  const Quadric<T> local{A.plusDiagonal(pq + qr + rp), cross(w, n) * sp + v * pq + u * rp,
                         sp * dot(n, n) + rp * dot(u, u) + pq * dot(v, v) + 3 * (pq * sr)};
  return local.relativeTo(-p);
}

/// Isotropic noise of one standard deviation for all corners, in their unit (equations 11-15 with Σ = sigma² I).
template <typename T>
constexpr Quadric<T> probabilisticTriangleQuadric(const Vec3<T>& p, const Vec3<T>& q, const Vec3<T>& r, T sigma) {
  return probabilisticTriangleQuadric(p, q, r, sigma, sigma, sigma);
}

}  // namespace pdc
