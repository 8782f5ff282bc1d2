#pragma once

#include <array>

#include "pdc/math/vec3.h"

namespace pdc {

/// A 3×3 matrix, rows first. Acts on column vectors.
struct Mat3d {
  std::array<Vec3d, 3> row{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};

  static constexpr Mat3d identity() { return {}; }
  static constexpr Mat3d diagonal(double x, double y, double z) {
    return {{Vec3d{x, 0, 0}, Vec3d{0, y, 0}, Vec3d{0, 0, z}}};
  }

  [[nodiscard]] constexpr Vec3d column(int i) const { return {row[0][i], row[1][i], row[2][i]}; }
  [[nodiscard]] constexpr Mat3d transposed() const { return {{column(0), column(1), column(2)}}; }
  [[nodiscard]] constexpr double determinant() const { return dot(row[0], cross(row[1], row[2])); }

  friend constexpr Vec3d operator*(const Mat3d& m, const Vec3d& v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
  }
  friend constexpr Mat3d operator*(const Mat3d& a, const Mat3d& b) {
    const Mat3d t = b.transposed();
    Mat3d r;
    for (int i = 0; i < 3; ++i) r.row[i] = {dot(a.row[i], t.row[0]), dot(a.row[i], t.row[1]), dot(a.row[i], t.row[2])};
    return r;
  }
  friend constexpr Mat3d operator*(const Mat3d& a, double s) { return {{a.row[0] * s, a.row[1] * s, a.row[2] * s}}; }
};

/// Inverse of a regular matrix; a singular one gives infinities or NaN, so test determinant() first.
constexpr Mat3d inverse(const Mat3d& m) {
  const double s = 1.0 / m.determinant();
  const Vec3d a = m.column(0), b = m.column(1), c = m.column(2);
  return {{cross(b, c) * s, cross(c, a) * s, cross(a, b) * s}};
}

}  // namespace pdc
