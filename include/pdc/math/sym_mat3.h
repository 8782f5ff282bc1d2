#pragma once

#include "pdc/math/vec3.h"

namespace pdc {

/// A symmetric 3×3 matrix: the six entries of its upper triangle.
template <typename T>
struct SymMat3 {
  T xx, xy, xz, yy, yz, zz;

  static constexpr SymMat3 identity() { return {1, 0, 0, 1, 0, 1}; }
  static constexpr SymMat3 zero() { return {0, 0, 0, 0, 0, 0}; }

  [[nodiscard]] constexpr T trace() const { return xx + yy + zz; }
  /// Entry (i, j), either triangle.
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

/// vᵀAv.
template <typename T>
constexpr T quadraticForm(const SymMat3<T>& a, const Vec3<T>& v) {
  return dot(v, a * v);
}

}  // namespace pdc
