#include "simplify/error_bound/star_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace pdc::detail {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The least cosine between a face's normal and the common one: rounding grows with the slope.
constexpr double kLeastCosine = 0.2;

/// A place over the plane: along it x and y, and z away from it.
using Place = Vec3d;

struct HeightTriangle {
  std::array<Place, 3> corners;
};
struct HeightEdge {
  Place from, to;
  std::uint32_t end;  ///< The vertex at `to`.
};

/// Twice the area of a triangle in the plane.
double area(const Place& a, const Place& b, const Place& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A surface over a region of the plane.
struct HeightSurface {
  std::vector<HeightTriangle> triangles;
  std::vector<HeightEdge> edges;  ///< Those inside.

  /// How far a place of the region is from the surface above or below it.
  [[nodiscard]] double gapAt(const Place& p) const {
    double inmost = -kInfinite, gap = kInfinite;
    for (const auto& [c] : triangles) {
      const double whole = area(c[0], c[1], c[2]);
      const std::array<double, 3> w{area(p, c[1], c[2]) / whole, area(c[0], p, c[2]) / whole,
                                    area(c[0], c[1], p) / whole};
      const double inside = *std::min_element(w.begin(), w.end());
      if (!(inside > inmost)) continue;
      inmost = inside;
      gap = std::abs(w[0] * c[0].z + w[1] * c[1].z + w[2] * c[2].z - p.z);
    }
    return gap;
  }
};

/// How far two edges are from each other where they cross, seen along the normal; 0 where they do not.
double gapAtCrossing(const HeightEdge& e, const HeightEdge& f) {
  const double fromE = area(f.from, f.to, e.from), toE = area(f.from, f.to, e.to);
  const double fromF = area(e.from, e.to, f.from), toF = area(e.from, e.to, f.to);
  if (!(fromE * toE < 0) || !(fromF * toF < 0)) return 0;
  const double s = fromE / (fromE - toE), t = fromF / (fromF - toF);
  return std::abs(e.from.z + (e.to.z - e.from.z) * s - f.from.z - (f.to.z - f.from.z) * t);
}

class StarGap {
 public:
  StarGap(const DecimatedSurface& surface, const VertexStars& stars, const ChosenCollapse& collapse)
      : mSurface(surface),
        mStars(stars),
        mCollapse(collapse),
        mOrigin(worldOf(collapse.a, surface.positions[collapse.a])) {}

  double find() {
    if (atBoundary(mStars[mCollapse.a]) || atBoundary(mStars[mCollapse.b])) return kInfinite;
    if (!findAxes()) return kInfinite;
    const Place a = placeOf(mCollapse.a), b = placeOf(mCollapse.b),
                to = project(worldOf(mCollapse.a, mCollapse.to.place));
    if (!addFaces(mCollapse.a, a, to) || !addFaces(mCollapse.b, b, to) || !isOneRound(to)) return kInfinite;
    double gap = std::max({mAfter.gapAt(a), mAfter.gapAt(b), mBefore.gapAt(to)});
    for (const HeightEdge& e : mBefore.edges)
      for (const HeightEdge& f : mAfter.edges)
        if (e.end != f.end) gap = std::max(gap, gapAtCrossing(e, f));
    return gap;
  }

 private:
  [[nodiscard]] Vec3d worldOf(std::uint32_t v, const Vec3d& local) const {
    return vecCast<double>(mSurface.written(v, local));
  }
  [[nodiscard]] Place project(const Vec3d& p) const {
    const Vec3d d = p - mOrigin;
    return {dot(mX, d), dot(mY, d), dot(mNormal, d)};
  }
  [[nodiscard]] Place placeOf(std::uint32_t v) const { return project(worldOf(v, mSurface.positions[v])); }

  /// The vector area of the faces, which is that of their boundary and thus the same before and after.
  bool findAxes() {
    Vec3d sum{};
    const Vec3d& p = mSurface.positions[mCollapse.a];
    for (const auto& [v, other] : {std::array{mCollapse.a, mCollapse.b}, std::array{mCollapse.b, mCollapse.a}})
      for (const StarCorner& c : mStars[v])
        if (c.next != other && c.previous != other)
          sum += cross(mSurface.positions[c.next] - p, mSurface.positions[c.previous] - p);
    const double l = length(sum);
    if (!(l > 0)) return false;
    mNormal = sum * (1 / l);
    const Vec3d aside = std::abs(mNormal.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    mX = cross(mNormal, aside);
    mX *= 1 / length(mX);
    mY = cross(mNormal, mX);
    return true;
  }

  /// Adds the faces and edges at an end of the edge as they are and as they become. \returns whether they are heights.
  bool addFaces(std::uint32_t v, const Place& place, const Place& to) {
    const std::uint32_t other = v == mCollapse.a ? mCollapse.b : mCollapse.a;
    for (const StarCorner& c : mStars[v]) {
      const Place next = placeOf(c.next), previous = placeOf(c.previous);
      const bool vanishes = c.next == other || c.previous == other;
      if (!add(mBefore, {{place, next, previous}})) return false;
      mBefore.edges.push_back({place, next, c.next});
      if (vanishes) continue;
      if (!add(mAfter, {{to, next, previous}})) return false;
      mAfter.edges.push_back({to, next, c.next});
    }
    return true;
  }

  static bool add(HeightSurface& surface, const HeightTriangle& t) {
    const auto& c = t.corners;
    const Vec3d n = cross(c[1] - c[0], c[2] - c[0]);
    surface.triangles.push_back(t);
    return n.z > 0 && n.z * n.z > kLeastCosine * kLeastCosine * dot(n, n);
  }

  /// Whether the boundary goes once around the new vertex: it is then the same region that both lie over.
  [[nodiscard]] bool isOneRound(const Place& to) const {
    int rounds = 0;
    for (const auto& [c] : mAfter.triangles) {
      const bool up = c[1].y <= to.y && c[2].y > to.y, down = c[1].y > to.y && c[2].y <= to.y;
      if ((up || down) && (area(c[1], c[2], to) > 0) == up) rounds += up ? 1 : -1;
    }
    return rounds == 1;
  }

  const DecimatedSurface& mSurface;
  const VertexStars& mStars;
  const ChosenCollapse& mCollapse;
  const Vec3d mOrigin;
  Vec3d mX{}, mY{}, mNormal{};
  HeightSurface mBefore, mAfter;
};

}  // namespace

double starGap(const DecimatedSurface& surface, const VertexStars& stars, const ChosenCollapse& collapse) {
  return StarGap(surface, stars, collapse).find();
}

}  // namespace pdc::detail
