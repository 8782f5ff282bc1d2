#include "mesh/oriented_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pdc::detail {
namespace {

/// More than the rounding errors of a few products and sums of numbers up to 1.
constexpr double kRounding = 1e-13;

struct LongestEdge {
  Vec3d edge{}, normal{};    ///< The normal is as long as twice the triangle's area.
  double squaredLength = 0;  ///< The square of the edge's length.

  explicit LongestEdge(const TriangleCorners& t) {
    for (int k = 0; k < 3; ++k) {
      const Vec3d e = vecCast<double>(t[(k + 1) % 3]) - vecCast<double>(t[k]);
      if (dot(e, e) <= squaredLength) continue;
      edge = e;
      squaredLength = dot(e, e);
      normal = cross(e, vecCast<double>(t[(k + 2) % 3]) - vecCast<double>(t[k]));
    }
  }
};

/// The unit vector along v without its part along the unit vector `without`; zero if hardly anything is left.
Vec3d unitWithout(const Vec3d& v, const Vec3d& without) {
  const Vec3d rest = v - without * dot(v, without);
  const double l = length(rest);
  return l > 0.1 * length(v) ? rest * (1 / l) : Vec3d{};
}

}  // namespace

OrientedBox::OrientedBox(const BoxF& box)
    : center(vecCast<double>(box.lo) * 0.5 + vecCast<double>(box.hi) * 0.5),
      half(vecCast<double>(box.hi) * 0.5 - vecCast<double>(box.lo) * 0.5) {
  const double slack = kRounding * std::max(largestEntry(center), largestEntry(half));
  half += Vec3d{slack, slack, slack};
}

OrientedBox::OrientedBox(const Axes& directions, std::span<const Vec3d> points, double margin) : axes(directions) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3d lo{kInfinity, kInfinity, kInfinity}, hi = -lo;
  double largest = 0;
  for (const Vec3d& p : points) {
    largest = std::max(largest, largestEntry(p));
    for (int k = 0; k < 3; ++k) {
      const double at = dot(axes[k], p);
      lo[k] = std::min(lo[k], at);
      hi[k] = std::max(hi[k], at);
    }
  }
  const double slack = kRounding * largest + margin;
  for (int k = 0; k < 3; ++k) {
    center += axes[k] * (0.5 * (lo[k] + hi[k]));
    half[k] = 0.5 * (hi[k] - lo[k]) + slack;
  }
}

std::array<Vec3d, 8> OrientedBox::corners() const {
  std::array<Vec3d, 8> result;
  for (unsigned i = 0; i < result.size(); ++i) {
    result[i] = center;
    for (int k = 0; k < 3; ++k) result[i] += axes[k] * ((i >> k & 1U) != 0 ? half[k] : -half[k]);
  }
  return result;
}

double OrientedBox::surface() const { return 8 * (half.x * half.y + half.y * half.z + half.z * half.x); }

bool OrientedBox::apartFrom(const OrientedBox& o) const {
  const Vec3d between = o.center - center;
  std::array<Vec3d, 3> cosines;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) cosines[i][k] = std::abs(dot(axes[i], o.axes[k]));
  for (int i = 0; i < 3; ++i) {
    const Vec3d column{cosines[0][i], cosines[1][i], cosines[2][i]};
    if (std::abs(dot(between, axes[i])) > half[i] + dot(o.half, cosines[i])) return true;
    if (std::abs(dot(between, o.axes[i])) > o.half[i] + dot(half, column)) return true;
  }
  return false;
}

OrientedBox::Axes axesAlong(const TriangleCorners& t) {
  const LongestEdge longest(t);
  if (longest.squaredLength == 0) return OrientedBox().axes;
  const Vec3d u = longest.edge * (1 / length(longest.edge));
  Vec3d n{};
  for (const Vec3d& v : {longest.normal, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}})
    if (n == Vec3d{}) n = unitWithout(v, u);
  return {u, cross(n, u), n};
}

bool isSliver(const TriangleCorners& t) {
  constexpr double kSlender = 16;
  const Vec3d a = vecCast<double>(t[0]), p = vecCast<double>(t[1]) - a, q = vecCast<double>(t[2]) - a, r = q - p;
  const Vec3d normal = cross(p, q);
  const double longest = std::max({dot(p, p), dot(q, q), dot(r, r)});
  return dot(normal, normal) * kSlender * kSlender < longest * longest;
}

}  // namespace pdc::detail
