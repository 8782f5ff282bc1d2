#include "simplify/error_bound/error_bound.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "simplify/error_bound/coverage.h"

namespace pdc::detail {
namespace {

Mesh meshOf(Buffer<Vec3f> positions, const Buffer<Triangle>& faces) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles = faces;
  return mesh;
}

/// Calls visit(corner) for each face at an edge's ends, once.
template <typename Visit>
void forEachChangedFace(const VertexStars& stars, const ChosenCollapse& collapse, const Visit& visit) {
  for (const StarCorner& c : stars[collapse.a]) visit(c);
  for (const StarCorner& c : stars[collapse.b])
    if (c.next != collapse.a && c.previous != collapse.a) visit(c);
}

bool contains(std::span<const std::uint32_t> all, std::uint32_t one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

}  // namespace

/// Some faces left, as Coverage asks for them.
class ErrorBound::NearFaces {
 public:
  void add(std::uint32_t face, const TrianglePoints& corners) {
    mNumbers.push_back(face);
    mPrisms.emplace_back(corners);
    mUsed.push_back(0);
  }
  /// Adds one about a vertex, its first corner, that all that have been added have. \param c its others.
  void addAround(std::uint32_t face, const TrianglePoints& corners, const StarCorner& c) {
    add(face, corners);
    mAround.push_back({c.next, c.previous, kNone, kNone});
    const auto own = static_cast<std::uint32_t>(mAround.size() - 1);
    for (std::uint32_t i = 0; i < own; ++i) {
      if (mAround[i].previous == c.next) {
        mAround[own].beyondNext = i;
        mAround[i].beyondPrevious = own;
      }
      if (mAround[i].next == c.previous) {
        mAround[own].beyondPrevious = i;
        mAround[i].beyondNext = own;
      }
    }
  }
  [[nodiscard]] std::size_t size() const { return mNumbers.size(); }
  /// Forgets those added last.
  void shrink(std::size_t size) {
    mNumbers.resize(size);
    mPrisms.resize(size);
    mUsed.resize(size);
  }
  [[nodiscard]] std::size_t indexOf(std::uint32_t face) const {
    return static_cast<std::size_t>(std::find(mNumbers.begin(), mNumbers.end(), face) - mNumbers.begin());
  }

  void forget() { std::fill(mUsed.begin(), mUsed.end(), 0); }
  void appendUsed(Faces& faces) const {
    for (std::size_t i = 0; i < mNumbers.size(); ++i)
      if (mUsed[i] != 0) faces.push_back(mNumbers[i]);
  }
  /// One to all of which a triangle is near, or kNone.
  [[nodiscard]] std::uint32_t oneNearTo(const TrianglePoints& triangle, double distance) const {
    for (std::size_t i = 0; i < mNumbers.size(); ++i)
      if (mPrisms[i].isNear(triangle, distance)) return mNumbers[i];
    return kNone;
  }
  [[nodiscard]] const TrianglePoints& corners(std::size_t i) const { return mPrisms[i].corners; }

  [[nodiscard]] const Prism& prism(std::uint32_t i) const { return mPrisms[i]; }
  [[nodiscard]] NearestTriangle nearest(const Vec3d& p, std::uint32_t) const {
    NearestTriangle nearest;
    for (std::uint32_t i = 0; i < mPrisms.size(); ++i) {
      const double squared = squaredToTriangle(p, mPrisms[i].corners);
      if (squared < nearest.squared) nearest = {i, squared};
    }
    return nearest;
  }
  [[nodiscard]] std::uint32_t beyond(std::uint32_t i, int k) const {
    if (i >= mAround.size()) return kNone;
    return k == 0 ? mAround[i].beyondNext : k == 2 ? mAround[i].beyondPrevious : kNone;
  }
  void use(std::uint32_t i) { mUsed[i] = 1; }

 private:
  /// Corners of a face about the vertex, and the faces across the edges from the vertex to them.
  struct Around {
    std::uint32_t next, previous, beyondNext, beyondPrevious;
  };

  Faces mNumbers;
  std::vector<Prism> mPrisms;
  std::vector<Around> mAround;
  std::vector<std::uint8_t> mUsed;
};

ErrorBound::ErrorBound(const Buffer<Triangle>& given, const DecimatedSurface& surface, const ErrorLimits& limits,
                       const Monitor& monitor)
    : mSurface(surface),
      mLimits(limits),
      mGiven(meshOf({surface.given.begin(), surface.given.end()}, given)),
      mEnvelope(mGiven, limits.farthest()),
      mFaces(surface.faces),
      mFaceGiven(surface.faces.size()),
      mBelow(surface.positions.size(), kNone),
      mFirstOfFace(surface.faces.size(), kNone),
      mFirstOfTriangle(given.size(), kNone),
      mJoinedAt(given.size(), kNone) {
  std::iota(mFaceGiven.begin(), mFaceGiven.end(), 0U);
  findLinks(monitor);
}

void ErrorBound::findLinks(const Monitor& monitor) {
  for (std::uint32_t v = 0; v < mSurface.positions.size(); ++v) mPlaces.push_back(placeOf(v));
  const Mesh now = meshOf(mPlaces, mFaces);
  std::vector<std::uint8_t> used(mPlaces.size(), 0);
  for (const Triangle& t : mFaces)
    for (const std::uint32_t v : t) used[v] = 1;
  std::vector<Faces> near(mGiven.triangles.size());
  {
    const Envelope about(now, mEnvelope.distance());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, near.size(), 256), [&](const auto& r) {
      if (monitor.stopped()) return;
      for (std::size_t t = r.begin(); t < r.end(); ++t)
        about.contains(trianglePoints(mGiven.positions, mGiven.triangles[t]), kNone, &near[t],
                       mLimits.of(static_cast<std::uint32_t>(t)));
    });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mPlaces.size(), 256), [&](const auto& r) {
      for (std::size_t v = r.begin(); v < r.end(); ++v)
        if (used[v] != 0) mBelow[v] = mEnvelope.nearest(vecCast<double>(mPlaces[v]), kNone);
    });
  }
  monitor.throwIfStopped();
  mLinks.reserve(near.size() * 2);
  for (std::uint32_t t = 0; t < near.size(); ++t) link(t, near[t]);
}

std::vector<ChosenCollapse> ErrorBound::takeOutFar(const VertexStars& stars, std::vector<ChosenCollapse>& collapses,
                                                   const Monitor& monitor) {
  std::vector<std::optional<Change>> found(collapses.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, collapses.size(), 4), [&](const auto& r) {
    if (monitor.stopped()) return;
    for (std::size_t i = r.begin(); i < r.end(); ++i) found[i] = changeOf(stars, collapses[i], monitor);
  });
  monitor.throwIfStopped();
  std::vector<ChosenCollapse> out, near;
  mChanges.clear();
  for (std::size_t i = 0; i < collapses.size(); ++i) {
    (found[i] ? near : out).push_back(collapses[i]);
    if (found[i]) mChanges.push_back(std::move(*found[i]));
  }
  collapses = std::move(near);
  return out;
}

std::vector<ChosenCollapse> ErrorBound::join(const VertexStars& stars, std::vector<ChosenCollapse>& collapses) {
  std::vector<ChosenCollapse> out, kept;
  std::vector<Change> joined;
  auto next = mChanges.begin();
  for (const ChosenCollapse& c : collapses) {
    while (next->collapse.a != c.a || next->collapse.b != c.b) ++next;
    if (!join(stars, *next)) {
      out.push_back(c);
      continue;
    }
    mPlaces[c.a] = mPlaces[c.b] = placeOf(c);
    kept.push_back(c);
    joined.push_back(std::move(*next));
  }
  mChanges = std::move(joined);
  collapses = std::move(kept);
  return out;
}

/// Joins a change to those before it. \returns whether it holds beside them; if not, nothing has changed.
bool ErrorBound::join(const VertexStars& stars, const Change& change) {
  const auto isJoined = [&](const Coverings::Triangle& t) { return mJoinedAt[t.number] != kNone; };
  Coverings both;
  if (std::any_of(change.covered.triangles.begin(), change.covered.triangles.end(), isJoined)) {
    const Faces changed = changedFaces(stars, change.collapse);
    NearFaces faces = newFaces(stars, change.collapse);
    for (const Coverings::Triangle& t : change.covered.triangles)
      if (isJoined(t) && !cover(t.number, mJoined.of(mJoined.triangles[mJoinedAt[t.number]]), changed, faces, both))
        return false;
  }
  setJoined(change.covered);
  setJoined(both);
  return true;
}

/// What is set later counts.
void ErrorBound::setJoined(const Coverings& coverings) {
  for (const Coverings::Triangle& t : coverings.triangles) {
    if (mJoinedAt[t.number] == kNone) {
      mJoinedAt[t.number] = static_cast<std::uint32_t>(mJoined.triangles.size());
      mJoined.triangles.emplace_back();
    }
    const auto begin = static_cast<std::uint32_t>(mJoined.faces.size());
    const std::span<const std::uint32_t> faces = coverings.of(t);
    mJoined.faces.insert(mJoined.faces.end(), faces.begin(), faces.end());
    mJoined.triangles[mJoinedAt[t.number]] = {t.number, begin, static_cast<std::uint32_t>(mJoined.faces.size())};
  }
}

/// The faces at an edge's ends, by the numbers they were given with.
ErrorBound::Faces ErrorBound::changedFaces(const VertexStars& stars, const ChosenCollapse& collapse) const {
  Faces faces;
  forEachChangedFace(stars, collapse, [&](const StarCorner& c) { faces.push_back(mFaceGiven[c.face]); });
  return faces;
}

/// What becomes of those that do not vanish.
ErrorBound::NearFaces ErrorBound::newFaces(const VertexStars& stars, const ChosenCollapse& collapse) const {
  NearFaces faces;
  const Vec3d place = vecCast<double>(placeOf(collapse));
  forEachChangedFace(stars, collapse, [&](const StarCorner& c) {
    if (c.next == collapse.b || c.previous == collapse.b) return;
    faces.addAround(mFaceGiven[c.face],
                    {place, vecCast<double>(placeOf(c.next)), vecCast<double>(placeOf(c.previous))}, c);
  });
  return faces;
}

/// The triangles given that some faces left are near to, ascending.
std::vector<std::uint32_t> ErrorBound::trianglesAt(const Faces& faces) const {
  std::vector<std::uint32_t> triangles;
  for (const std::uint32_t f : faces)
    for (std::uint32_t i = mFirstOfFace[f]; i != kNone; i = mLinks[i].nextOfFace)
      if (mLinks[i].triangle != kNone) triangles.push_back(mLinks[i].triangle);
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

void ErrorBound::facesOf(std::uint32_t triangle, Faces& faces) const {
  faces.clear();
  for (std::uint32_t i = mFirstOfTriangle[triangle]; i != kNone; i = mLinks[i].nextOfTriangle)
    faces.push_back(mLinks[i].face);
}

/// Finds faces that are near to a triangle given, of the new ones and of those before that do not change.
bool ErrorBound::cover(std::uint32_t triangle, std::span<const std::uint32_t> before, const Faces& changed,
                       NearFaces& faces, Coverings& out) const {
  const TrianglePoints corners = trianglePoints(mGiven.positions, mGiven.triangles[triangle]);
  const double limit = mLimits.of(triangle);
  const auto begin = static_cast<std::uint32_t>(out.faces.size());
  const auto add = [&] {
    out.triangles.push_back({triangle, begin, static_cast<std::uint32_t>(out.faces.size())});
    return true;
  };
  // Most are near to one.
  if (const std::uint32_t one = faces.oneNearTo(corners, limit); one != kNone) {
    out.faces.push_back(one);
    return add();
  }
  const std::size_t size = faces.size();
  std::size_t guess = size;
  for (const std::uint32_t f : before) {
    if (!contains(changed, f))
      faces.add(f, trianglePoints(mPlaces, mFaces[f]));
    else if (guess == size)
      guess = faces.indexOf(f);
  }
  faces.forget();
  const auto near = guess < size ? static_cast<std::uint32_t>(guess) : kNone;
  const bool covers = Coverage<NearFaces>(faces, limit).covers(corners, near);
  if (covers) faces.appendUsed(out.faces);
  faces.shrink(size);
  return covers && add();
}

/// Whether new faces are near to the surface given: as near as each triangle asks that they or those before them are
/// near to. \param below a triangle given that is near to them.
bool ErrorBound::areNear(const NearFaces& faces, const Faces& changed, std::uint32_t below) const {
  double limit = mLimits.farthest();
  if (!mLimits.uniform()) limit = mLimits.least(trianglesAt(changed));
  for (std::size_t i = 0; i < faces.size(); ++i) {
    Faces near;
    double tried = 0, own = limit;
    do {
      tried = own;
      near.clear();
      if (!mEnvelope.contains(faces.corners(i), below, mLimits.uniform() ? nullptr : &near, tried)) return false;
      // What is near within a wide limit may ask for a narrower one.
      own = mLimits.least(near);
    } while (own < tried);
  }
  return true;
}

std::optional<ErrorBound::Change> ErrorBound::changeOf(const VertexStars& stars, const ChosenCollapse& collapse,
                                                       const Monitor& monitor) const {
  const Vec3d place = vecCast<double>(placeOf(collapse));
  Change change{collapse, mEnvelope.nearest(place, mBelow[collapse.a]), {}};
  if (change.below == kNone) return std::nullopt;
  NearFaces faces = newFaces(stars, collapse);
  const Faces changed = changedFaces(stars, collapse);
  if (!areNear(faces, changed, change.below)) return std::nullopt;
  Faces before;
  for (const std::uint32_t t : trianglesAt(changed)) {
    // One face may stand for all triangles given.
    if (monitor.stopped()) return std::nullopt;
    facesOf(t, before);
    if (!cover(t, before, changed, faces, change.covered)) return std::nullopt;
  }
  return change;
}

void ErrorBound::accept(const VertexStars& stars) {
  for (const Coverings::Triangle& t : mJoined.triangles) unlink(t.number);
  for (const Change& c : mChanges) {
    mBelow[c.collapse.a] = c.below;
    for (const std::uint32_t f : changedFaces(stars, c.collapse)) {
      for (std::uint32_t i = mFirstOfFace[f]; i != kNone; i = mLinks[i].nextOfFace) mFree.push_back(i);
      mFirstOfFace[f] = kNone;
      for (std::uint32_t& v : mFaces[f]) v = v == c.collapse.b ? c.collapse.a : v;
    }
  }
  for (const Coverings::Triangle& t : mJoined.triangles) {
    link(t.number, mJoined.of(t));
    mJoinedAt[t.number] = kNone;
  }
  mChanges.clear();
  mJoined = {};
}

void ErrorBound::link(std::uint32_t triangle, std::span<const std::uint32_t> faces) {
  for (const std::uint32_t f : faces) {
    const Link link{triangle, f, mFirstOfTriangle[triangle], mFirstOfFace[f]};
    std::uint32_t i = static_cast<std::uint32_t>(mLinks.size());
    if (mFree.empty()) {
      mLinks.push_back(link);
    } else {
      i = mFree.back();
      mFree.pop_back();
      mLinks[i] = link;
    }
    mFirstOfTriangle[triangle] = mFirstOfFace[f] = i;
  }
}

void ErrorBound::unlink(std::uint32_t triangle) {
  for (std::uint32_t i = mFirstOfTriangle[triangle]; i != kNone; i = mLinks[i].nextOfTriangle)
    mLinks[i].triangle = kNone;
  mFirstOfTriangle[triangle] = kNone;
}

}  // namespace pdc::detail
