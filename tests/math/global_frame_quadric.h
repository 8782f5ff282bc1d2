#pragma once

#include "pdc/math/quadric.h"

namespace pdc {

/// The isotropic probabilistic triangle quadric as equations 11-15 are printed, from cross products of the positions
/// themselves. Equal to probabilisticTriangleQuadric in exact arithmetic; here to show what is lost in single
/// precision.
template <typename T>
Quadric<T> globalFrameTriangleQuadric(const Vec3<T>& p, const Vec3<T>& q, const Vec3<T>& r, T sigma) {
  const Vec3<T> pq = cross(p, q), qr = cross(q, r), rp = cross(r, p), n = pq + qr + rp;
  const T s = sigma * sigma, d = dot(pq, r);
  const SymMat3<T> A = outer(n) + crossSquare(p - q, s) + crossSquare(q - r, s) + crossSquare(r - p, s);
  const Vec3<T> first = cross(q - p, pq) + cross(r - q, qr) + cross(p - r, rp);
  return {A.plusDiagonal(6 * s * s), n * d + first * s + (p + q + r) * (2 * s * s),
          d * d + s * (dot(pq, pq) + dot(qr, qr) + dot(rp, rp)) + 2 * s * s * (dot(p, p) + dot(q, q) + dot(r, r)) +
              6 * s * s * s};
}

}  // namespace pdc
