#pragma once

#include <array>

#include "pdc/math/vec3.h"

namespace pdc {

/// A 3×3 matrix, rows first, that acts on column vectors. A plain value; the identity by default. Indices are 0 to 2
/// and are not checked.
template <typename T>
struct Mat3 {
  std::array<Vec3<T>, 3> row{Vec3<T>{1, 0, 0}, Vec3<T>{0, 1, 0}, Vec3<T>{0, 0, 1}};

  static constexpr Mat3 identity() { return {}; }
  static constexpr Mat3 diagonal(T x, T y, T z) { return {{Vec3<T>{x, 0, 0}, Vec3<T>{0, y, 0}, Vec3<T>{0, 0, z}}}; }

  [[nodiscard]] constexpr Vec3<T> column(int i) const { return {row[0][i], row[1][i], row[2][i]}; }
  [[nodiscard]] constexpr Mat3 transposed() const { return {{column(0), column(1), column(2)}}; }
  [[nodiscard]] constexpr T determinant() const { return dot(row[0], cross(row[1], row[2])); }

  friend constexpr Vec3<T> operator*(const Mat3& m, const Vec3<T>& v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
  }
  friend constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
    const Mat3 t = b.transposed();
    Mat3 r;
    for (int i = 0; i < 3; ++i) r.row[i] = {dot(a.row[i], t.row[0]), dot(a.row[i], t.row[1]), dot(a.row[i], t.row[2])};
    return r;
  }
  friend constexpr Mat3 operator*(const Mat3& a, T s) { return {{a.row[0] * s, a.row[1] * s, a.row[2] * s}}; }
};

/// The inverse of a regular matrix, by cofactors. A singular one, or one whose determinant over- or underflows, gives
/// infinities or NaN.
template <typename T>
constexpr Mat3<T> inverse(const Mat3<T>& m) {
  const T s = 1 / m.determinant();
  const Vec3<T> a = m.column(0), b = m.column(1), c = m.column(2);
  return {{cross(b, c) * s, cross(c, a) * s, cross(a, b) * s}};
}

/// Every entry converted as static_cast does.
template <typename To, typename From>
constexpr Mat3<To> matCast(const Mat3<From>& m) {
  return {{vecCast<To>(m.row[0]), vecCast<To>(m.row[1]), vecCast<To>(m.row[2])}};
}

using Mat3d = Mat3<double>;
using Mat3f = Mat3<float>;

}  // namespace pdc
