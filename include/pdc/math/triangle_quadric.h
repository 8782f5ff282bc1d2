#pragma once

#include "pdc/math/quadric.h"

/// Error quadrics of triangles (Trettner & Kobbelt 2020, section 3.2). All weigh by the square of twice the area. They
/// are pure functions of finite numbers that throw nothing; NaN passes through, and signs of standard deviations do not
/// matter.
///
/// Corners are relative to the caller's origin, and so is the result: pass p − o, q − o, r − o for a triangle near o.
/// The quadrics are built from the differences q − p and r − p, then moved to the origin, so A is exact to rounding at
/// any distance; the sum p×q + q×r + r×p, the same in exact arithmetic, has lost every digit a thousand edges away in
/// single precision. A grows with the fourth, b with the fifth and c with the sixth power of the unit of length.
///
/// The long formulas are always inlined, because compilers would otherwise call them and pass their scalars through
/// memory.
namespace pdc {

/// The cross-interference matrix Ci[A, B] (equation 12): bilinear, symmetric in A and B, and 2I for A = B = I (equation
/// 13). Ci[eeᵀ, B] = [e]× B [e]×ᵀ, which makes it all that equation 11 is made of.
template <typename T>
constexpr SymMat3<T> crossInterference(const SymMat3<T>& A, const SymMat3<T>& B) {
  return {A.yy * B.zz - 2 * (A.yz * B.yz) + A.zz * B.yy,         A.xz * B.yz - A.xy * B.zz + A.yz * B.xz - A.zz * B.xy,
          A.xy * B.yz - A.xz * B.yy + A.yz * B.xy - A.yy * B.xz, A.xx * B.zz - 2 * (A.xz * B.xz) + A.zz * B.xx,
          A.xy * B.xz - A.xx * B.yz + A.xz * B.xy - A.yz * B.xx, A.xx * B.yy - 2 * (A.xy * B.xy) + A.yy * B.xx};
}

/// Squared distance to the plane of the triangle, times (2 area)² (equation 9). Its rank is one, or zero for corners on
/// one line.
template <typename T>
constexpr Quadric<T> triangleQuadric(const Vec3<T>& p, const Vec3<T>& q, const Vec3<T>& r) {
  return planeQuadric(p, cross(q - p, r - p));
}

namespace detail {

/// [e]× S, whose columns are the cross products of e with those of S.
template <typename T>
constexpr Mat3<T> crossTimes(const Vec3<T>& e, const SymMat3<T>& S) {
  return {{Vec3<T>{e.y * S.xz - e.z * S.xy, e.y * S.yz - e.z * S.yy, e.y * S.zz - e.z * S.yz},
           Vec3<T>{e.z * S.xx - e.x * S.xz, e.z * S.xy - e.x * S.yz, e.z * S.xz - e.x * S.zz},
           Vec3<T>{e.x * S.xy - e.y * S.xx, e.x * S.yy - e.y * S.xy, e.x * S.yz - e.y * S.xz}}};
}

/// K [e]×ᵀ for K = crossTimes(e, S): symmetric, and crossInterference(outer(e), S) up to rounding.
template <typename T>
constexpr SymMat3<T> timesCross(const Mat3<T>& K, const Vec3<T>& e) {
  const Vec3<T>&a = K.row[0], &b = K.row[1], &c = K.row[2];
  return {e.y * a.z - e.z * a.y, e.z * a.x - e.x * a.z, e.x * a.y - e.y * a.x,
          e.z * b.x - e.x * b.z, e.x * b.y - e.y * b.x, e.x * c.y - e.y * c.x};
}

/// The sum of v × Su over the terms uvᵀ that G is the sum of.
template <typename T>
constexpr Vec3<T> sumOfCrosses(const SymMat3<T>& S, const Mat3<T>& G) {
  const Vec3<T> x = S * G.column(0), y = S * G.column(1), z = S * G.column(2);
  return {y.z - z.y, z.x - x.z, x.y - y.x};
}

}  // namespace detail

/// Expectation of triangleQuadric for independent corners distributed as N(p, Sigma_p), N(q, Sigma_q), N(r, Sigma_r)
/// (equations 11, 14 and 15). Positive definite whenever the covariances are, for collinear corners too, though then
/// only by the second-order terms: no single first-order term [e]× Σ [e]×ᵀ is more than semidefinite.
template <typename T>
[[gnu::always_inline]] constexpr Quadric<T> probabilisticTriangleQuadric(const Vec3<T>& p, const Vec3<T>& q,
                                                                         const Vec3<T>& r, const SymMat3<T>& Sigma_p,
                                                                         const SymMat3<T>& Sigma_q,
                                                                         const SymMat3<T>& Sigma_r) {
  const Vec3<T> u = q - p, v = r - p, w = r - q, n = cross(u, v);
  // With q and r noisy and p at its mean: E[nnᵀ], E[wwᵀ], E[nwᵀ].
  const Mat3<T> uR = detail::crossTimes(u, Sigma_r), vQ = detail::crossTimes(v, Sigma_q);
  const SymMat3<T> nn =
      outer(n) + detail::timesCross(uR, u) + detail::timesCross(vQ, v) + crossInterference(Sigma_q, Sigma_r);
  const SymMat3<T> ww = outer(w) + (Sigma_q + Sigma_r);
  const Mat3<T> nw{{uR.row[0] + vQ.row[0] + w * n.x, uR.row[1] + vQ.row[1] + w * n.y, uR.row[2] + vQ.row[2] + w * n.z}};
  // Moving p by d turns n into n + w × d and leaves n·d as it is.
  const SymMat3<T> A = nn + crossInterference(ww, Sigma_p);
  const Vec3<T> b = detail::sumOfCrosses(Sigma_p, nw), Ap = A * p;
  return {A, b + Ap, traceOfProduct(Sigma_p, nn) + dot(p, Ap + b + b)};
}

/// Expectation of triangleQuadric for isotropic noise with a standard deviation for each corner, in the unit of the
/// corners (equations 11-15 with Σp = sigma_p² I, …).
template <typename T>
[[gnu::always_inline]] constexpr Quadric<T> probabilisticTriangleQuadric(const Vec3<T>& p, const Vec3<T>& q,
                                                                         const Vec3<T>& r, T sigma_p, T sigma_q,
                                                                         T sigma_r) {
  const Vec3<T> u = q - p, v = r - p, w = r - q, n = cross(u, v);
  const T sp = sigma_p * sigma_p, sq = sigma_q * sigma_q, sr = sigma_r * sigma_r;
  // Ci[σa² I, σb² I] = 2 σa² σb² I, of which the trace with σc² I is 6 σa² σb² σc².
  const T pq = 2 * (sp * sq), qr = 2 * (sq * sr), rp = 2 * (sr * sp);
  const SymMat3<T> A =
      (outer(n) + crossSquare(u, sr) + crossSquare(v, sq) + crossSquare(w, sp)).plusDiagonal(pq + qr + rp);
  const Vec3<T> b = cross(w, n) * sp + v * pq + u * rp, Ap = A * p;
  return {A, b + Ap, sp * dot(n, n) + rp * dot(u, u) + pq * dot(v, v) + 3 * (pq * sr) + dot(p, Ap + b + b)};
}

/// Expectation of triangleQuadric for isotropic noise with one standard deviation for all corners, in their unit
/// (equations 11-15 with Σ = sigma² I). Its minimum is at the centroid.
template <typename T>
[[gnu::always_inline]] constexpr Quadric<T> probabilisticTriangleQuadric(const Vec3<T>& p, const Vec3<T>& q,
                                                                         const Vec3<T>& r, T sigma) {
  const Vec3<T> u = q - p, v = r - p, w = r - q, m = u + v, n = cross(u, v), centroid = p + m * (T(1) / 3);
  const T s = sigma * sigma, k = 6 * (s * s);
  // The three edges make two terms: s (uuᵀ + vvᵀ + wwᵀ) = s (3 wwᵀ + mmᵀ) / 2. They are written entry by entry, because
  // g++ does not vectorise loops over triangles where matrices are passed around.
  const Vec3<T> sw = w * (T(1.5) * s), sm = m * (T(0.5) * s);
  const T xx = w.x * sw.x + m.x * sm.x, yy = w.y * sw.y + m.y * sm.y, zz = w.z * sw.z + m.z * sm.z;
  const T yk = yy + k, zk = zz + k;
  const SymMat3<T> A{n.x * n.x + yy + zk, n.x * n.y - w.x * sw.y - m.x * sm.y, n.x * n.z - w.x * sw.z - m.x * sm.z,
                     n.y * n.y + xx + zk, n.y * n.z - w.y * sw.z - m.y * sm.z, n.z * n.z + xx + yk};
  const Vec3<T> b = A * centroid;
  return {{A.xx, A.xy, A.xz, A.yy, A.yz, A.zz},
          {b.x, b.y, b.z},
          dot(centroid, b) + s * (dot(n, n) * (T(1) / 3) + (xx + yy + zz) * (T(2) / 3) + k)};
}

}  // namespace pdc
