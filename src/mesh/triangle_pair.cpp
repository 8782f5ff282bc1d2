#include "mesh/triangle_pair.h"

#include <algorithm>
#include <utility>

#include "pdc/math/predicates.h"

namespace pdc::detail {
namespace {

using Signs = TriangleSides::Signs;
/// Corners in double precision, which holds them exactly.
using Corners = std::array<Vec3d, 3>;

constexpr int next(int i) { return i == 2 ? 0 : i + 1; }

Corners widened(const TriangleCorners& t) {
  return {vecCast<double>(t[0]), vecCast<double>(t[1]), vecCast<double>(t[2])};
}

/// Turns a triangle so that corner `first` is in front.
Corners rotated(const TriangleCorners& t, int first) {
  return {vecCast<double>(t[first]), vecCast<double>(t[next(first)]), vecCast<double>(t[next(next(first))])};
}

Signs rotated(const Signs& s, int first) { return {s[first], s[next(first)], s[next(next(first))]}; }

int sideOf(const Corners& t, const Vec3d& p) { return orient3d(t[0], t[1], t[2], p); }
/// The side of a point that may be known already; 0: it is not.
int sideOf(const Corners& t, const Vec3d& p, int known) { return known != 0 ? known : sideOf(t, p); }
Signs sidesOf(const Corners& t, const Corners& of, const Signs& known) {
  return {sideOf(t, of[0], known[0]), sideOf(t, of[1], known[1]), sideOf(t, of[2], known[2])};
}

/// Whether no two of the signs are opposite.
bool agree(int a, int b, int c) { return std::min({a, b, c}) >= 0 || std::max({a, b, c}) <= 0; }

bool boxesApart(const TriangleCorners& a, const TriangleCorners& b) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [aLo, aHi] = std::minmax({a[0][axis], a[1][axis], a[2][axis]});
    const auto [bLo, bHi] = std::minmax({b[0][axis], b[1][axis], b[2][axis]});
    if (aHi < bLo || bHi < aLo) return true;
  }
  return false;
}

/// A plane figure seen along the axis in which triangle `t` keeps an area.
class PlaneView {
 public:
  explicit PlaneView(const Corners& t) {
    while (mAxis > 0 && turn(t[0], t[1], t[2]) == 0) --mAxis;
  }

  [[nodiscard]] int turn(const Vec3d& p, const Vec3d& q, const Vec3d& r) const { return orient2d(p, q, r, mAxis); }

  /// Whether an edge of triangle `t` has the points strictly on its outer side.
  template <typename... Points>
  [[nodiscard]] bool edgeOfSeparates(const Corners& t, const Points&... points) const {
    const int inside = turn(t[0], t[1], t[2]);
    for (int i = 0; i < 3; ++i) {
      const Vec3d &p = t[i], &q = t[next(i)];
      if (((turn(p, q, points) == -inside) && ...)) return true;
    }
    return false;
  }

  /// Two convex figures are apart exactly if an edge of one of them separates them.
  [[nodiscard]] bool segmentMeets(const Vec3d& p, const Vec3d& q, const Corners& t) const {
    const int side = turn(p, q, t[0]);
    if (side != 0 && turn(p, q, t[1]) == side && turn(p, q, t[2]) == side) return false;
    return !edgeOfSeparates(t, p, q);
  }

 private:
  int mAxis = 2;
};

/// Triangles that share the edge t[0] t[1]; `s` is the other corner of the second one.
bool foldedOver(const Corners& t, const Vec3d& s) {
  if (sideOf(t, s) != 0) return false;
  const PlaneView view(t);
  return view.turn(t[0], t[1], s) == view.turn(t[0], t[1], t[2]);
}

/// Triangles that share the corner a[0] = b[0].
bool meetBeyondCorner(const Corners& a, const Corners& b, const TriangleSides& known) {
  const int a1 = sideOf(b, a[1], known.a[1]), a2 = sideOf(b, a[2], known.a[2]);
  if (a1 * a2 > 0) return false;
  const int b1 = sideOf(a, b[1], known.b[1]), b2 = sideOf(a, b[2], known.b[2]);
  if (b1 * b2 > 0) return false;
  if (a1 == 0 && a2 == 0) {
    const PlaneView view(a);
    return view.segmentMeets(a[1], a[2], b) || view.segmentMeets(b[1], b[2], a);
  }
  // A segment that crosses a triangle's plane meets the triangle if it passes all its edges on the same side. It passes
  // those through the shared corner as it lies to the planes, so one question is left, and it is the same for both.
  const int pass = orient3d(a[1], a[2], b[1], b[2]);
  return agree(a1, -a2, pass) || agree(b1, -b2, pass);
}

/// Triangles in one plane that share no corner.
bool meetInPlane(const Corners& a, const Corners& b) {
  const PlaneView view(a);
  return !view.edgeOfSeparates(a, b[0], b[1], b[2]) && !view.edgeOfSeparates(b, a[0], a[1], a[2]);
}

/// The corner that has a side for itself.
int loneCorner(const Signs& s) { return s[1] == s[2] ? 0 : s[0] == s[2] ? 1 : 2; }

/// Triangles each of which has corners strictly on both sides of the other's plane, and none in it. Each leaves an
/// interval on the line where the planes cross, between the two edges at its lone corner. Each interval must begin
/// before the other ends (Guigue and Devillers 2003, Fast and Robust Triangle-Triangle Overlap Test).
bool intervalsMeet(const Corners& a, const Corners& b, const Signs& as, const Signs& bs) {
  const int i = loneCorner(as), k = loneCorner(bs);
  int iStart = next(i), iEnd = next(iStart), kStart = next(k), kEnd = next(kStart);
  // Now it is as if both lone corners were before the other's plane.
  if (as[i] < 0) std::swap(kStart, kEnd);
  if (bs[k] < 0) std::swap(iStart, iEnd);
  return orient3d(a[i], a[iStart], b[k], b[kStart]) <= 0 && orient3d(a[i], a[iEnd], b[k], b[kEnd]) >= 0;
}

/// Triangles that share no corner.
bool meetAnywhere(const Corners& a, const Corners& b, const TriangleSides& known) {
  const Signs as = sidesOf(b, a, known.a);
  if (as[0] != 0 && as[1] == as[0] && as[2] == as[0]) return false;
  const Signs bs = sidesOf(a, b, known.b);
  if (bs[0] != 0 && bs[1] == bs[0] && bs[2] == bs[0]) return false;
  if (as[0] * as[1] * as[2] * bs[0] * bs[1] * bs[2] != 0) return intervalsMeet(a, b, as, bs);
  if (as == Signs{}) return meetInPlane(a, b);

  // On the line where the planes cross, both triangles leave an interval. Intervals meet where one has an end in the
  // other, and an end is where an edge crosses the other plane; edges within that plane add no end.
  const auto pass = [&](int i, int j) { return orient3d(a[i], a[next(i)], b[j], b[next(j)]); };  // Edges of a and b.
  const auto crosses = [](const Signs& s, int i) { return s[i] * s[next(i)] <= 0 && (s[i] != 0 || s[next(i)] != 0); };
  for (int i = 0; i < 3; ++i) {
    if (crosses(as, i) && agree(pass(i, 0), pass(i, 1), pass(i, 2))) return true;
    if (crosses(bs, i) && agree(pass(0, i), pass(1, i), pass(2, i))) return true;
  }
  return false;
}

}  // namespace

bool isDegenerate(const TriangleCorners& t) { return collinear(t[0], t[1], t[2]); }

bool trianglesIntersect(const TriangleCorners& a, const Triangle& aVertices, const TriangleCorners& b,
                        const Triangle& bVertices, const TriangleSides& known) {
  // match[i] is the corner of b at the same vertex as corner i of a, or none.
  constexpr int kNone = -1;
  std::array<int, 3> match{kNone, kNone, kNone};
  int shared = 0, lastShared = 0, notShared = 2;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      if (aVertices[i] == bVertices[j]) match[i] = j;
    (match[i] == kNone ? notShared : lastShared) = i;
    shared += match[i] != kNone;
  }
  if (shared == 0) return !boxesApart(a, b) && meetAnywhere(widened(a), widened(b), known);
  if (shared == 1) {
    const int i = lastShared, j = match[i];
    return meetBeyondCorner(rotated(a, i), rotated(b, j), {rotated(known.a, i), rotated(known.b, j)});
  }
  // b's corner off the edge: the indices of b's corners add up to 3.
  const int p = next(notShared), q = next(p), off = 3 - match[p] - match[q];
  return known.b[off] == 0 && foldedOver(rotated(a, p), vecCast<double>(b[off]));
}

}  // namespace pdc::detail
