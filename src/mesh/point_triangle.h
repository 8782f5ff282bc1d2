#pragma once

#include <algorithm>
#include <array>

#include "pdc/math/vec3.h"

namespace pdc::detail {

/// Corners of a triangle in double precision.
using TrianglePoints = std::array<Vec3d, 3>;

/// A point of a triangle, as weights of its corners.
using TriangleWeights = std::array<double, 3>;

/// The point of a triangle nearest to p (Ericson 2005, section 5.1.5).
[[nodiscard]] inline TriangleWeights nearestPoint(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double t = (d4 - d3) / (d4 - d3 + d5 - d6);
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

[[nodiscard]] inline double squaredToSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d ab = b - a;
  const double l = dot(ab, ab);
  const double t = l > 0 ? std::clamp(dot(p - a, ab) / l, 0.0, 1.0) : 0;
  const Vec3d d = p - a - ab * t;
  return dot(d, d);
}

/// The square of the distance from p to a triangle; needs no division by what is small in slivers.
[[nodiscard]] inline double squaredToTriangle(const Vec3d& p, const TrianglePoints& v) {
  const Vec3d n = cross(v[1] - v[0], v[2] - v[0]);
  const double area = dot(n, n);
  bool above = area > 0;
  for (int k = 0; k < 3 && above; ++k) above = dot(cross(n, v[(k + 1) % 3] - v[k]), p - v[k]) >= 0;
  if (above) {
    const double h = dot(n, p - v[0]);
    return h * h / area;
  }
  return std::min({squaredToSegment(p, v[0], v[1]), squaredToSegment(p, v[1], v[2]), squaredToSegment(p, v[2], v[0])});
}

}  // namespace pdc::detail
