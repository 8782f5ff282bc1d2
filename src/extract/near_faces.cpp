#include "extract/near_faces.h"

#include <algorithm>
#include <cmath>

#include "extract/vertex_solver.h"
#include "pdc/math/predicates.h"

namespace pdc::detail {
namespace {

Vec3d lattice(const Coord& c) { return {double(c[0]), double(c[1]), double(c[2])}; }

void grow(Vec3f& low, Vec3f& high, const TriangleCorners& t) {
  for (const Vec3f& p : t)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
}

}  // namespace

bool FaceTests::passes(const EdgeRef& e, const Quad& quad) const {
  Vec3d from = lattice(mRings.low(e)), to = from;
  to[e.axis()] += 1;
  if (!mRings.lowInside(e)) std::swap(from, to);
  const Vec3d behind = mMap.position(from), before = mMap.position(to);
  const auto p = [&](int i) { return vecCast<double>(mMesh.positions[quad[i]]); };
  const auto crossed = [&](int a, int b, int c) {
    return orient3d(p(a), p(b), p(c), behind) < 0 && orient3d(p(a), p(b), p(c), before) > 0;
  };
  return crossed(0, 1, 2) && crossed(0, 2, 3);
}

bool FaceTests::facesForward(const EdgeRef& e, const TriangleCorners& t) const {
  Vec3d from = lattice(mRings.low(e)), to = from;
  to[e.axis()] += 1;
  if (!mRings.lowInside(e)) std::swap(from, to);
  const Vec3d d = mMap.affine() ? mMap.jacobian({}) * (to - from) : mMap.position(to) - mMap.position(from);
  const Vec3d p = vecCast<double>(t[0]);
  const Vec3d n = cross(vecCast<double>(t[1]) - p, vecCast<double>(t[2]) - p);
  // Differences of floats are exact or nearly so; what is left is far below this share.
  constexpr double kRounding = 1e-14;
  const double size = length(vecCast<double>(t[1]) - p) * length(vecCast<double>(t[2]) - p) * length(d);
  return dot(n, d) > kRounding * size;
}

void FaceTests::triangles(const EdgeRef& e, std::vector<Triangle>& out) const {
  out.clear();
  if (mFans.has(e)) return mFans.triangles(e, out);
  const Quad& q = mMesh.quads[mRings.face(e)];
  out.push_back({q[0], q[1], q[2]});
  out.push_back({q[0], q[2], q[3]});
}

/// \returns false if the faces' box is apart from that of the face being looked at.
bool NearFaces::load(const EdgeRef& e, std::vector<Face>& faces) {
  mTests.triangles(e, mTriangles);
  faces.clear();
  for (const Triangle& t : mTriangles) faces.push_back({t, mTests.corners(t)});
  Vec3f low = faces[0].corners[0], high = low;
  for (const Face& f : faces) grow(low, high, f.corners);
  if (&faces == &mOwn) {
    mLow = low;
    mHigh = high;
  }
  return low.x <= mHigh.x && mLow.x <= high.x && low.y <= mHigh.y && mLow.y <= high.y && low.z <= mHigh.z &&
         mLow.z <= high.z;
}

std::pair<Vec3d, Vec3d> NearFaces::latticeBox(const EdgeRef& e) const {
  if (!mTests.map().affine()) {
    const Vec3d low = lattice(mTests.rings().low(e)), reach{kFreeHalfSize + 1, kFreeHalfSize + 1, kFreeHalfSize + 1};
    return {low - reach, low + reach};
  }
  Vec3d low{1e300, 1e300, 1e300}, high = low * -1.0;
  const Mat3d toLattice = inverse(mTests.map().jacobian({}));
  const Vec3d origin = mTests.map().position({});
  for (const Face& f : mOwn)
    for (const Vec3f& corner : f.corners) {
      const Vec3d p = toLattice * (vecCast<double>(corner) - origin);
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
    }
  return {low, high};
}

void NearFaces::test(const EdgeRef& e, const EdgeRef& other, std::vector<Offence>& out) {
  if (other == e || !load(other, mOther)) return;
  for (const Face& a : mOwn)
    for (const Face& b : mOther)
      if (trianglesIntersect(a.corners, a.vertices, b.corners, b.vertices))
        out.push_back({e, other, a.vertices, b.vertices});
}

void NearFaces::findOffences(const EdgeRef& e, const std::vector<EdgeRef>& active, std::vector<Offence>& out) {
  static_cast<void>(load(e, mOwn));
  for (std::size_t i = 0; i < mOwn.size(); ++i) {
    if (!mTests.facesForward(e, mOwn[i].corners)) {
      out.push_back({e, e, mOwn[i].vertices, mOwn[i].vertices});
      return;
    }
    for (std::size_t j = 0; j < i; ++j)
      if (trianglesIntersect(mOwn[i].corners, mOwn[i].vertices, mOwn[j].corners, mOwn[j].vertices))
        out.push_back({e, e, mOwn[j].vertices, mOwn[i].vertices});
  }
  const auto [low, high] = latticeBox(e);
  // A vertex in its cell is at most 1 from the low end of each of its edges on any axis; a free one, this much.
  const auto around = [&low = low, &high = high](double reach) {
    Coord from, to;
    for (int i = 0; i < 3; ++i) {
      from[i] = static_cast<std::int32_t>(std::ceil(low[i] - reach));
      to[i] = static_cast<std::int32_t>(std::floor(high[i] + reach));
    }
    return std::pair(from, to);
  };
  const auto [nearFrom, nearTo] = around(1);
  mTests.rings().forEachIn(nearFrom, nearTo, nullptr, [&](const EdgeRef& other) {
    if (other < e && std::binary_search(active.begin(), active.end(), other)) return;
    test(e, other, out);
  });
  const auto [farFrom, farTo] = around(kFreeHalfSize + 0.5);
  mTests.rings().forEachIn(farFrom, farTo, &mTests.farReaching(), [&, from = nearFrom, to = nearTo](const EdgeRef& o) {
    const Coord p = mTests.rings().low(o);
    const bool near =
        p[0] >= from[0] && p[0] <= to[0] && p[1] >= from[1] && p[1] <= to[1] && p[2] >= from[2] && p[2] <= to[2];
    if (!near) test(e, o, out);
  });
}

}  // namespace pdc::detail
