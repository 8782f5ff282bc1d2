#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "mesh/point_triangle.h"

namespace pdc::detail {

/// What is above and below a triangle.
struct Prism {
  Prism() = default;
  explicit Prism(const TrianglePoints& points) : corners(points) {
    const Vec3d n = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double l = length(n);
    flat = l > 0;
    normal = flat ? n * (1 / l) : Vec3d{};
    for (int k = 0; k < 3; ++k) {
      const Vec3d in = cross(normal, corners[(k + 1) % 3] - corners[k]);
      const double size = length(in);
      flat = flat && size > 0;
      inward[k] = size > 0 ? in * (1 / size) : Vec3d{};
    }
  }

  /// How far a point is inside the plane through the edge after corner k.
  [[nodiscard]] double depth(int k, const Vec3d& p) const { return dot(inward[k], p - corners[k]); }
  [[nodiscard]] double height(const Vec3d& p) const { return dot(normal, p - corners[0]); }

  /// Whether all of a convex polygon is within a distance of the triangle.
  [[nodiscard]] bool isNear(std::span<const Vec3d> polygon, double distance) const {
    for (const Vec3d& p : polygon) {
      if (std::abs(height(p)) > distance) return false;
      const double least = std::min({depth(0, p), depth(1, p), depth(2, p)});
      if (flat && least >= 0) continue;
      if (least < -distance && flat) return false;
      if (!(squaredToTriangle(p, corners) <= distance * distance)) return false;
    }
    return true;
  }

  TrianglePoints corners;
  Vec3d normal;
  std::array<Vec3d, 3> inward;  ///< Unit normals of the planes through the edges.
  bool flat = false;            ///< Whether the triangle has an area.
};

/// Finds out whether all points of a triangle are within a distance of a surface, to a millionth of the distance. It is
/// cut along the prisms of the surface's triangles, since the distance to one triangle is convex: where the corners of
/// a part are near, all of it is. What remains over edges and vertices is halved.
///
/// \tparam Surface has triangles with numbers: `prism(number)`; `nearest(point, guess)`, a NearestTriangle, which need
/// not be found where it is not nearer than the distance; `beyond(number, k)`, the triangle across the edge after
/// corner k, or kNone; `use(number)`, called for each triangle that parts are near to.
template <typename Surface>
class Coverage {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  Coverage(Surface& surface, double distance) : mSurface(surface), mDistance(distance), mRest(rest()) {}

  /// Where it is closer than can be told the answer is no. \param near a triangle of the surface that may be near; only
  /// saves time.
  [[nodiscard]] bool covers(const TrianglePoints& triangle, std::uint32_t near) {
    mRest.clear();
    Piece whole;
    std::copy(triangle.begin(), triangle.end(), whole.corners.begin());
    whole.size = 3;
    whole.near = near;
    mRest.push_back(whole);
    for (std::size_t parts = 0; !mRest.empty(); ++parts) {
      if (parts == kMostParts) return false;
      const Piece piece = mRest.back();
      mRest.pop_back();
      if (!takeApart(piece)) return false;
    }
    return true;
  }

 private:
  /// What counts as rounding, and parts of what size count as outside if they still are not known to be inside,
  /// relative to the distance.
  static constexpr double kRounding = 1e-6, kLeastSize = 1e-3;
  /// With more parts than this a triangle counts as outside.
  static constexpr std::size_t kMostParts = 1 << 18;
  /// So many triangles are gone through towards the one below a part.
  static constexpr int kMostSteps = 8;

  /// A convex part of the triangle.
  struct Piece {
    static constexpr int kMost = 12;
    std::array<Vec3d, kMost> corners;
    int size = 0;
    std::uint32_t near = kNone;  ///< The surface's triangle to be looked at next; kNone for the nearest.
  };

  /// Takes away what is known to be inside of a piece and leaves the rest. \returns false if a point of it is outside.
  bool takeApart(const Piece& piece) {
    if (piece.size > Piece::kMost - 5) {
      bisect(piece);
      return true;
    }
    const Vec3d center = centerOf(piece);
    std::uint32_t t = piece.near, last = kNone;
    for (int step = 0; t != kNone && step < kMostSteps; ++step) {
      const Prism& prism = mSurface.prism(t);
      if (reduce(piece, t, prism)) return true;
      last = t;
      t = towards(center, t, prism);
    }
    const auto nearest = mSurface.nearest(center, last);
    const double d = std::sqrt(nearest.squared);
    if (!(d < mDistance)) return false;
    if (nearest.number != last && reduce(piece, nearest.number, mSurface.prism(nearest.number))) return true;
    // The distance grows by no more than one goes.
    const double radius = length(farthestFrom(center, piece) - center);
    if (d + radius <= mDistance) {
      mSurface.use(nearest.number);
      return true;
    }
    if (radius < kLeastSize * mDistance) return false;
    halve(piece, center, nearest.number);
    return true;
  }

  /// The triangle across the edge beyond which a point is farthest; kNone if it is above or below.
  [[nodiscard]] std::uint32_t towards(const Vec3d& p, std::uint32_t t, const Prism& prism) const {
    int farthest = 0;
    std::array<double, 3> depths;
    for (int k = 0; k < 3; ++k) {
      depths[k] = prism.depth(k, p);
      if (depths[k] < depths[farthest]) farthest = k;
    }
    return depths[farthest] < 0 ? mSurface.beyond(t, farthest) : kNone;
  }

  /// Takes away what is above or below a triangle of the surface and within the distance of it.
  /// \returns whether there was any; if not, nothing has changed.
  bool reduce(const Piece& piece, std::uint32_t t, const Prism& prism) {
    if (prism.isNear({piece.corners.data(), static_cast<std::size_t>(piece.size)}, mDistance)) {
      mSurface.use(t);
      return true;
    }
    if (!prism.flat) return false;
    const std::size_t before = mRest.size();
    Piece within = piece;
    bool any = true;
    for (int k = 0; k < 3 && any; ++k)
      any = cut(within, mSurface.beyond(t, k), [&](const Vec3d& p) { return prism.depth(k, p); });
    for (const double side : {1.0, -1.0})
      any = any && cut(within, kNone, [&](const Vec3d& p) { return mDistance - side * prism.height(p); });
    if (any)
      mSurface.use(t);
    else
      mRest.resize(before);
    return any;
  }

  /// Leaves of a piece what is on the positive side of a plane, and puts what is on the other side to the rest.
  /// \param depth distance from the plane. \param beyond where the other side is to be looked for.
  /// \returns whether anything is left; if not, nothing is put to the rest.
  template <typename Depth>
  bool cut(Piece& piece, std::uint32_t beyond, const Depth& depth) {
    std::array<double, Piece::kMost> depths;
    double least = 0, most = 0;
    for (int i = 0; i < piece.size; ++i) {
      depths[i] = depth(piece.corners[i]);
      least = std::min(least, depths[i]);
      most = std::max(most, depths[i]);
    }
    const double rounding = kRounding * mDistance;
    if (most <= rounding) return false;
    if (least >= -rounding) return true;
    Piece inside, outside;
    for (int i = 0; i < piece.size; ++i) {
      const int j = i + 1 < piece.size ? i + 1 : 0;
      if (depths[i] >= 0) inside.corners[inside.size++] = piece.corners[i];
      if (depths[i] <= 0) outside.corners[outside.size++] = piece.corners[i];
      if (!(depths[i] * depths[j] < 0)) continue;
      const Vec3d between =
          piece.corners[i] + (piece.corners[j] - piece.corners[i]) * (depths[i] / (depths[i] - depths[j]));
      inside.corners[inside.size++] = outside.corners[outside.size++] = between;
    }
    outside.near = beyond;
    mRest.push_back(outside);
    piece = inside;
    return true;
  }

  /// Parts a piece of many corners along a diagonal.
  void bisect(const Piece& piece) {
    const int middle = piece.size / 2;
    Piece first, second;
    first.near = second.near = piece.near;
    for (int i = 0; i <= middle; ++i) first.corners[first.size++] = piece.corners[i];
    for (int i = middle; i <= piece.size; ++i) second.corners[second.size++] = piece.corners[i % piece.size];
    mRest.push_back(first);
    mRest.push_back(second);
  }

  /// Parts a piece across where it is longest.
  void halve(const Piece& piece, const Vec3d& center, std::uint32_t near) {
    const Vec3d along = farthestFrom(center, piece) - center;
    const double l = length(along);
    Piece half = piece;
    half.near = near;
    cut(half, near, [&](const Vec3d& p) { return dot(along, p - center) / l; });
    mRest.push_back(half);
  }

  /// Memory that is kept, since most triangles need but little.
  static std::vector<Piece>& rest() {
    thread_local std::vector<Piece> pieces;
    return pieces;
  }

  [[nodiscard]] static Vec3d centerOf(const Piece& piece) {
    Vec3d center{};
    for (int i = 0; i < piece.size; ++i) center += piece.corners[i];
    return center * (1.0 / piece.size);
  }

  /// The corner farthest from a point.
  [[nodiscard]] static Vec3d farthestFrom(const Vec3d& p, const Piece& piece) {
    Vec3d farthest = p;
    for (int i = 0; i < piece.size; ++i) {
      const Vec3d d = piece.corners[i] - p, most = farthest - p;
      if (dot(d, d) > dot(most, most)) farthest = piece.corners[i];
    }
    return farthest;
  }

  Surface& mSurface;
  const double mDistance;
  std::vector<Piece>& mRest;
};

}  // namespace pdc::detail
