#include "mesh/polygons/ear_clipping.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pdc/math/predicates.h"

namespace pdc::detail {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// How far single precision may put a coordinate off, as a share of it: some units in the last place.
constexpr double kRounding = 4 * std::numeric_limits<float>::epsilon();

/// Half the normal times the area on both sides, by Newell's sum.
Vec3d newellNormal(std::span<const std::uint32_t> polygon, const Buffer<Vec3f>& positions) {
  const auto at = [&](std::size_t i) { return vecCast<double>(positions[polygon[i]]); };
  const Vec3d first = at(0);
  Vec3d sum{};
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += cross(at(i - 1) - first, at(i) - first);
  return sum;
}

bool isBetween(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const auto [lowX, highX] = std::minmax(a.x, b.x);
  const auto [lowY, highY] = std::minmax(a.y, b.y);
  return p != a && p != b && lowX <= p.x && p.x <= highX && lowY <= p.y && p.y <= highY;
}

}  // namespace

void EarClipper::triangulate(std::span<const std::uint32_t> polygon, const Buffer<Vec3f>& positions, Triangle* out) {
  mPolygon = polygon;
  mOut = out;
  if (!project(polygon, positions) || isFan()) {
    for (Index k = 2; k < polygon.size(); ++k) put(0, k - 1, k);
    return;
  }
  start();
  while (mLeft > 3) {
    clipQueued();
    if (mLeft <= 3) break;
    if (!clipThin()) clipUnsafe();
  }
  if (mLeft > 0) clipRest();
}

/// Drops the coordinate along which the polygon looks largest; then it is counter-clockwise. \returns false if that
/// cannot be said.
bool EarClipper::project(std::span<const std::uint32_t> polygon, const Buffer<Vec3f>& positions) {
  const Vec3d normal = newellNormal(polygon, positions);
  if (!std::isfinite(normal.x) || !std::isfinite(normal.y) || !std::isfinite(normal.z)) return false;
  int axis = std::abs(normal.y) > std::abs(normal.x) ? 1 : 0;
  if (std::abs(normal.z) >= std::abs(normal[axis])) axis = 2;
  int x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(x, y);
  mPoints.resize(polygon.size());
  mRounding = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d p = vecCast<double>(positions[polygon[i]]);
    mPoints[i] = {p[x], p[y]};
    mRounding = std::max(mRounding, kRounding * largestEntry(p));
  }
  return true;
}

int EarClipper::turn(Index a, Index b, Index c) const {
  const PlanePoint &p = mPoints[a], &q = mPoints[b], &r = mPoints[c];
  return orient2d(p.x, p.y, q.x, q.y, r.x, r.y);
}

bool EarClipper::isThin(Index a, Index b, Index c) const {
  const PlanePoint &p = mPoints[a], &q = mPoints[b], &r = mPoints[c];
  const double twiceArea = std::abs((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
  const double longest =
      std::max({std::hypot(q.x - p.x, q.y - p.y), std::hypot(r.x - q.x, r.y - q.y), std::hypot(p.x - r.x, p.y - r.y)});
  return twiceArea <= mRounding * longest;
}

/// Whether all triangles from the first corner turn forward, and none is thin; those of repeated corners have no area
/// in any case. Such triangles overlap only where the polygon goes around that corner more than once, and then it meets
/// itself.
bool EarClipper::isFan() const {
  for (Index k = 2; k < mPoints.size(); ++k) {
    const int forward = turn(0, k - 1, k);
    const bool repeated = mPoints[k - 1] == mPoints[k] || mPoints[0] == mPoints[k - 1] || mPoints[0] == mPoints[k];
    if (!repeated && (forward <= 0 || isThin(0, k - 1, k))) return false;
  }
  return true;
}

EarClipper::Shape EarClipper::shapeOf(Index i) const {
  const Index before = mPrevious[i], after = mNext[i];
  const int t = turn(before, i, after);
  if (t != 0) return t > 0 ? Shape::kConvex : Shape::kReflex;
  return isBetween(mPoints[i], mPoints[before], mPoints[after]) ? Shape::kFlat : Shape::kSpike;
}

void EarClipper::start() {
  const auto size = static_cast<Index>(mPoints.size());
  mLeft = size;
  mCursor = 0;
  mUnsafeTests = 0;
  mPrevious.resize(size);
  mNext.resize(size);
  mShapes.resize(size);
  mRemoved.assign(size, 0);
  mQueued.assign(size, 0);
  mFirstWaiting.assign(size, kNone);
  mWaiting.clear();
  mQueue.clear();
  mThin.clear();
  mThinDone = 0;
  mNotConvex.clear();
  for (Index i = 0; i < size; ++i) {
    mPrevious[i] = i == 0 ? size - 1 : i - 1;
    mNext[i] = i + 1 == size ? 0 : i + 1;
  }
  for (Index i = 0; i < size; ++i) {
    mShapes[i] = shapeOf(i);
    if (mShapes[i] != Shape::kConvex) mNotConvex.push_back(i);
    enqueue(i);
  }
  mGrid.fill(mPoints, mNotConvex);
}

void EarClipper::enqueue(Index i) {
  if (mShapes[i] != Shape::kConvex && mShapes[i] != Shape::kSpike) return;
  if (std::exchange(mQueued[i], std::uint8_t{1}) == 0) mQueue.push_back(i);
}

/// Ears in the order in which they came, so that all around the polygon triangles grow alike.
void EarClipper::clipQueued() {
  for (std::size_t k = 0; k < mQueue.size() && mLeft > 3; ++k) {
    mQueued[mQueue[k]] = 0;
    tryEar(mQueue[k], false);
  }
  mQueue.clear();
}

/// Takes the first thin ear. \returns whether there was one.
bool EarClipper::clipThin() {
  while (mThinDone < mThin.size())
    if (tryEar(mThin[mThinDone++], true)) return true;
  return false;
}

/// An ear that is blocked waits for the corner that blocks it.
bool EarClipper::tryEar(Index i, bool evenIfThin) {
  if (mRemoved[i] != 0 || mShapes[i] == Shape::kReflex || mShapes[i] == Shape::kFlat) return false;
  const bool convex = mShapes[i] == Shape::kConvex;
  if (convex && !evenIfThin && isThin(mPrevious[i], i, mNext[i])) {
    mThin.push_back(i);
    return false;
  }
  const Index by = convex ? blocker(i, Test::kClosed) : kNone;
  if (by == kNone) {
    clip(i);
    return true;
  }
  mWaiting.push_back({i, mFirstWaiting[by]});
  mFirstWaiting[by] = static_cast<Index>(mWaiting.size() - 1);
  return false;
}

/// Only polygons that meet themselves come here. Takes the next corner with nothing inside its triangle; without one,
/// or when looking has taken long enough, the next convex one; and if there is none either, all that is left.
void EarClipper::clipUnsafe() {
  const std::size_t most = 8 * mPoints.size();
  Index convex = kNone;
  Index i = mCursor;
  for (std::size_t k = 0; k < mLeft; ++k, i = mNext[i]) {
    ++mUnsafeTests;
    if (mShapes[i] != Shape::kConvex) continue;
    if (convex == kNone) convex = i;
    if (mUnsafeTests > most) break;
    if (blocker(i, Test::kInside) == kNone) return clip(i);
  }
  if (convex == kNone || mUnsafeTests > 2 * most) return clipRest();
  clip(convex);
}

void EarClipper::put(Index a, Index b, Index c) { *mOut++ = {mPolygon[a], mPolygon[b], mPolygon[c]}; }

void EarClipper::clip(Index i) {
  const Index before = mPrevious[i], after = mNext[i];
  put(before, i, after);
  mNext[before] = after;
  mPrevious[after] = before;
  mRemoved[i] = 1;
  --mLeft;
  mCursor = after;
  wake(i);
  for (const Index neighbour : {before, after}) {
    mShapes[neighbour] = shapeOf(neighbour);
    enqueue(neighbour);
    if (mShapes[neighbour] == Shape::kConvex) wake(neighbour);
  }
}

void EarClipper::clipRest() {
  for (Index i = mNext[mNext[mCursor]]; i != mCursor; i = mNext[i]) put(mCursor, mPrevious[i], i);
  mLeft = 0;
}

/// Ears that a corner blocked are looked at again.
void EarClipper::wake(Index i) {
  for (Index k = std::exchange(mFirstWaiting[i], kNone); k != kNone; k = mWaiting[k].next)
    if (mRemoved[mWaiting[k].ear] == 0) enqueue(mWaiting[k].ear);
}

EarClipper::Index EarClipper::blocker(Index ear, Test test) const {
  Index found = kNone;
  mGrid.visitNear(mPoints[mPrevious[ear]], mPoints[ear], mPoints[mNext[ear]], [&](Index i) {
    if (mRemoved[i] != 0 || mShapes[i] == Shape::kConvex || !isBlocked(ear, i, test)) return false;
    found = i;
    return true;
  });
  return found;
}

bool EarClipper::isBlocked(Index ear, Index by, Test test) const {
  const Index a = mPrevious[ear], c = mNext[ear];
  // Where the polygon comes back to a corner of the ear, as where a hole is joined to the outline by an edge that is
  // passed twice, it enters the ear only with another corner inside.
  for (const Index corner : {a, ear, c})
    if (mPoints[by] == mPoints[corner]) return false;
  const int ab = turn(a, ear, by), bc = turn(ear, c, by), ca = turn(c, a, by);
  return test == Test::kInside ? ab > 0 && bc > 0 && ca > 0 : ab >= 0 && bc >= 0 && ca >= 0;
}

}  // namespace pdc::detail
