#pragma once

#include "pdc/math/mat3.h"
#include "pdc/math/vec3.h"

namespace pdc {

/// A symmetric 3×3 matrix: the six entries of its upper triangle. A plain aggregate, uninitialised unless made with {}.
template <typename T>
struct SymMat3 {
  T xx, xy, xz, yy, yz, zz;

  static constexpr SymMat3 identity() { return {1, 0, 0, 1, 0, 1}; }
  static constexpr SymMat3 zero() { return {0, 0, 0, 0, 0, 0}; }

  [[nodiscard]] constexpr T trace() const { return xx + yy + zz; }
  /// This matrix + sI.
  [[nodiscard]] constexpr SymMat3 plusDiagonal(T s) const { return {xx + s, xy, xz, yy + s, yz, zz + s}; }
  /// Entry (i, j) of either triangle, i and j from 0 to 2; not checked.
  [[nodiscard]] constexpr T operator()(int i, int j) const {
    const int k = i + j;
    return i == j ? (i == 0 ? xx : i == 1 ? yy : zz) : (k == 1 ? xy : k == 2 ? xz : yz);
  }

  constexpr SymMat3& operator+=(const SymMat3& o) { return *this = *this + o; }

  friend constexpr SymMat3 operator+(const SymMat3& a, const SymMat3& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
  }
  friend constexpr SymMat3 operator-(const SymMat3& a, const SymMat3& b) { return a + b * T(-1); }
  friend constexpr SymMat3 operator*(const SymMat3& a, T s) {
    return {a.xx * s, a.xy * s, a.xz * s, a.yy * s, a.yz * s, a.zz * s};
  }
  friend constexpr Vec3<T> operator*(const SymMat3& a, const Vec3<T>& v) {
    return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
            a.xz * v.x + a.yz * v.y + a.zz * v.z};
  }
  friend constexpr bool operator==(const SymMat3&, const SymMat3&) = default;
};

/// vvᵀ.
template <typename T>
constexpr SymMat3<T> outer(const Vec3<T>& v) {
  return {v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
}

/// [v]× [v]×ᵀ s = (|v|² I − vvᵀ) s.
template <typename T>
constexpr SymMat3<T> crossSquare(const Vec3<T>& v, T s) {
  const Vec3<T> w = v * s;
  const T xx = v.x * w.x, yy = v.y * w.y, zz = v.z * w.z;
  return {yy + zz, -(v.x * w.y), -(v.x * w.z), xx + zz, -(v.y * w.z), xx + yy};
}

/// vᵀAv.
template <typename T>
constexpr T quadraticForm(const SymMat3<T>& a, const Vec3<T>& v) {
  return dot(v, a * v);
}

/// KᵀAK.
template <typename T>
constexpr SymMat3<T> congruence(const SymMat3<T>& A, const Mat3<T>& K) {
  const Vec3<T> k0 = K.column(0), k1 = K.column(1), k2 = K.column(2);
  const Vec3<T> a0 = A * k0, a1 = A * k1, a2 = A * k2;
  return {dot(k0, a0), dot(k0, a1), dot(k0, a2), dot(k1, a1), dot(k1, a2), dot(k2, a2)};
}

/// Tr[AB].
template <typename T>
constexpr T traceOfProduct(const SymMat3<T>& a, const SymMat3<T>& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2 * (a.xy * b.xy + a.xz * b.xz + a.yz * b.yz);
}

}  // namespace pdc
