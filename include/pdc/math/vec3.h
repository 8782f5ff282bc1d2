#pragma once

#include <algorithm>
#include <cmath>

namespace pdc {

/// A point or direction of three scalars. A plain aggregate: `Vec3d v;` is uninitialised, `Vec3d{}` is zero. Arithmetic
/// is that of the scalars, entry by entry, NaN and infinities included.
template <typename T>
struct Vec3 {
  T x, y, z;

  /// Entry i, from 0 to 2; not checked.
  constexpr T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr const T& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }

  constexpr Vec3& operator+=(const Vec3& o) { return *this = *this + o; }
  constexpr Vec3& operator-=(const Vec3& o) { return *this = *this - o; }
  constexpr Vec3& operator*=(T s) { return *this = *this * s; }

  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(const Vec3& a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(T s, const Vec3& a) { return a * s; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

template <typename T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <typename T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The Euclidean norm. Squares over- or underflow where entries exceed about 1e±154 in double or 1e±19 in single
/// precision.
template <typename T>
T length(const Vec3<T>& a) {
  return std::sqrt(dot(a, a));
}

/// The maximum norm; that of the other entries where one is NaN, unless that is x.
template <typename T>
T largestEntry(const Vec3<T>& a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

/// Every entry converted as static_cast does.
template <typename To, typename From>
constexpr Vec3<To> vecCast(const Vec3<From>& a) {
  return {static_cast<To>(a.x), static_cast<To>(a.y), static_cast<To>(a.z)};
}

using Vec3d = Vec3<double>;
using Vec3f = Vec3<float>;

}  // namespace pdc
