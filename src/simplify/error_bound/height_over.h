#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/point_triangle.h"

namespace pdc::detail {

/// What lies over a triangle, seen along its normal, of a surface that is a height there: far faster to find out than
/// distances, which are smaller.
///
/// From one triangle of the surface over it, all are gone through across the edges that are over it. Since each of them
/// faces the triangle and none has an open edge there, every point of it has one of them over it.
///
/// \tparam Surface has triangles with numbers: `corners(number)`, TrianglePoints; `beyond(number, k)`, the triangle
/// across the edge after corner k, or kNone.
template <typename Surface>
class HeightOver {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  enum class Answer : std::uint8_t {
    kNear,    ///< Nowhere over the triangle is the surface farther than the distance.
    kFar,     ///< It is, seen along the normal, at farPlace().
    kUnknown  ///< It is no height there, or has too many triangles.
  };

  HeightOver(const Surface& surface, const TrianglePoints& base) : mSurface(surface), mOrigin(base[0]) {
    mX = base[1] - base[0];
    mNormal = cross(mX, base[2] - base[0]);
    const double l = length(mX), area = length(mNormal);
    if (!(area > 0)) return;
    mX *= 1 / l;
    mNormal *= 1 / area;
    mY = cross(mNormal, mX);
    for (int k = 0; k < 3; ++k) mBase[k] = project(base[k]);
    mFlat = false;
  }

  /// \param start a triangle of the surface near to this one.
  [[nodiscard]] Answer find(double distance, std::uint32_t start) {
    if (mFlat || !locate(start)) return Answer::kUnknown;
    std::vector<std::uint32_t>& all = memory();
    all.assign(1, start);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Projected t = projected(all[i]);
      if (!t.upright) return Answer::kUnknown;
      if (isFar(t, distance)) return Answer::kFar;
      for (int k = 0; k < 3; ++k) {
        if (!isOver(t, k)) continue;
        const std::uint32_t beyond = mSurface.beyond(all[i], k);
        if (beyond == kNone) return Answer::kUnknown;
        if (std::find(all.begin(), all.end(), beyond) != all.end()) continue;
        if (all.size() == kMostTriangles) return Answer::kUnknown;
        all.push_back(beyond);
      }
    }
    return Answer::kNear;
  }

  /// A point of the triangle.
  [[nodiscard]] Vec3d farPlace() const { return mOrigin + mX * mFar.x + mY * mFar.y; }

 private:
  /// The least cosine between normals: rounding grows with the slope.
  static constexpr double kLeastCosine = 0.2;
  /// So many triangles are gone through on the way to the first, and so many over one triangle.
  static constexpr int kMostSteps = 32;
  static constexpr std::size_t kMostTriangles = 128;

  /// Along the plane x and y, and z away from it.
  using Place = Vec3d;
  struct Projected {
    std::array<Place, 3> corners;
    std::array<std::array<double, 3>, 3> depths;  ///< By corner and edge: how far it is inside, times a length.
    bool upright;
  };

  /// Twice the area of a triangle in the plane.
  static double area(const Place& a, const Place& b, const Place& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }

  [[nodiscard]] Place project(const Vec3d& p) const {
    const Vec3d d = p - mOrigin;
    return {dot(mX, d), dot(mY, d), dot(mNormal, d)};
  }

  [[nodiscard]] Projected projected(std::uint32_t number) const {
    Projected t;
    const TrianglePoints corners = mSurface.corners(number);
    for (int i = 0; i < 3; ++i) {
      t.corners[i] = project(corners[i]);
      for (int k = 0; k < 3; ++k) t.depths[i][k] = area(mBase[k], mBase[(k + 1) % 3], t.corners[i]);
    }
    const Vec3d n = cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
    t.upright = n.z > 0 && n.z * n.z > kLeastCosine * kLeastCosine * dot(n, n);
    return t;
  }

  /// Goes to a triangle over the middle. \returns whether it got there.
  bool locate(std::uint32_t& t) const {
    const Place middle = (mBase[0] + mBase[1] + mBase[2]) * (1.0 / 3);
    for (int step = 0; step < kMostSteps && t != kNone; ++step) {
      const TrianglePoints corners = mSurface.corners(t);
      const std::array<Place, 3> c{project(corners[0]), project(corners[1]), project(corners[2])};
      int across = 0;
      double least = 0;
      for (int k = 0; k < 3; ++k) {
        const double inside = area(c[k], c[(k + 1) % 3], middle);
        if (inside < least) {
          least = inside;
          across = k;
        }
      }
      if (least == 0) return true;
      t = mSurface.beyond(t, across);
    }
    return false;
  }

  /// Whether an edge has a point over the triangle (Liang & Barsky 1984).
  static bool isOver(const Projected& t, int edge) {
    double from = 0, to = 1;
    for (int k = 0; k < 3; ++k) {
      const double a = t.depths[edge][k], b = t.depths[(edge + 1) % 3][k];
      if (a < 0 && b < 0) return false;
      if (a < 0) from = std::max(from, a / (a - b));
      if (b < 0) to = std::min(to, a / (a - b));
    }
    return from <= to;
  }

  /// Whether the part of a surface's triangle that is over this one is anywhere farther than the distance.
  bool isFar(const Projected& t, double distance) {
    if (std::all_of(t.corners.begin(), t.corners.end(), [&](const Place& p) { return std::abs(p.z) <= distance; }))
      return false;
    // At most one corner more with each edge that cuts.
    std::array<Place, 6> part, rest;
    int size = 3;
    std::copy(t.corners.begin(), t.corners.end(), part.begin());
    for (int k = 0; k < 3; ++k) {
      const int before = size;
      std::swap(part, rest);
      size = 0;
      for (int i = 0; i < before; ++i) {
        const Place &p = rest[i], &q = rest[i + 1 < before ? i + 1 : 0];
        const double a = area(mBase[k], mBase[(k + 1) % 3], p), b = area(mBase[k], mBase[(k + 1) % 3], q);
        if (a >= 0) part[size++] = p;
        if (a * b < 0) part[size++] = p + (q - p) * (a / (a - b));
      }
    }
    for (int i = 0; i < size; ++i)
      if (!(std::abs(part[i].z) <= distance)) {
        mFar = part[i];
        return true;
      }
    return false;
  }

  /// Memory that is kept.
  static std::vector<std::uint32_t>& memory() {
    thread_local std::vector<std::uint32_t> triangles;
    return triangles;
  }

  const Surface& mSurface;
  const Vec3d mOrigin;
  Vec3d mX{}, mY{}, mNormal{};
  std::array<Place, 3> mBase{};
  Place mFar{};
  bool mFlat = true;  ///< The triangle has no area.
};

}  // namespace pdc::detail
