#include "extract/certify/vertex_trial.h"

#include <algorithm>
#include <numeric>

#include "math/lane_loops.h"

namespace pdc::detail {
namespace {

bool hasVertex(std::span<const std::uint32_t> vertices, std::uint32_t v) {
  return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
}

Float4Box boxOf(std::span<const Vec3f> points) {
  Float4Box box(std::array<Vec3f, 1>{points[0]});
  for (const Vec3f& p : points) box.add(float4(p));
  return box;
}

/// For each corner, all bits if it is none of the others.
std::array<std::uint8_t, 3> notAmong(const Triangle& others, const Triangle& corners) {
  std::array<std::uint8_t, 3> mask;
  for (int k = 0; k < 3; ++k)
    mask[k] = corners[k] == others[0] || corners[k] == others[1] || corners[k] == others[2] ? 0 : 0xFF;
  return mask;
}

}  // namespace

VertexTrial::VertexTrial(const FaceBoxes& boxes, const FaceTests& faces, const SuspectVertex& vertex,
                         std::span<const Vec3f> places)
    : mBoxes(boxes), mFaces(faces), mPlaces(places), mVertex(static_cast<std::uint32_t>(vertex.vertex)) {
  const Float4Box ofPlaces = boxOf(places);
  Float4Box all = ofPlaces;
  faces.edgeCells().forEachEdgeAt(
      vertex, [&](const EdgeRef& e) { all.add(Float4Box(faces.corners(faces.edgeCells().vertices(e)))); });
  addFaces(vertex.block, all);
  computeSides();
  mOrder.resize(mPieces.size());
  std::iota(mOrder.begin(), mOrder.end(), std::size_t{0});
  for (OwnTriangle& own : mOwn) addNear(own, ofPlaces);
}

/// Adds the faces that may reach into a box.
void VertexTrial::addFaces(std::int32_t block, const Float4Box& box) {
  std::vector<Triangle> triangles;
  FaceBoxes::About(mBoxes, block).forEach(box, [&](const EdgeRef& e, std::uint64_t face) {
    const Quad* quad = mFaces.quad(face);
    mFaces.triangles(e, face, triangles);
    if (quad != nullptr && hasVertex(*quad, mVertex)) {
      addOwn(e, triangles);
      return true;
    }
    for (const Triangle& t : triangles) {
      if (hasVertex(t, mVertex))
        addOwn(e, {&t, 1});
      else
        mFixed.emplace_back(t, mFaces.corners(t));
    }
    return true;
  });
}

void VertexTrial::addOwn(const EdgeRef& e, std::span<const Triangle> triangles) {
  mPieces.push_back({mFaces.forward(e), mOwn.size(), triangles.size()});
  for (const Triangle& t : triangles) {
    OwnTriangle& own = mOwn.emplace_back(OwnTriangle{{t, mFaces.corners(t)}, -1, {}, 0, 0, {}, {}});
    for (int k = 0; k < 3; ++k) {
      if (t[k] == mVertex) {
        own.moving = k;
        continue;
      }
      const auto at = std::find(mRim.begin(), mRim.end(), t[k]);
      own.point[k] = static_cast<std::uint32_t>(at - mRim.begin());
      if (at == mRim.end()) mRim.push_back(t[k]);
    }
  }
}

void VertexTrial::computeSides() {
  std::vector<Points> points;
  const auto add = [&points](std::size_t n, auto&& position) {
    const std::size_t column = 4 * points.size();
    for (std::size_t i = 0; i < n; i += 4)
      points.emplace_back(std::array{position(i), position(std::min(i + 1, n - 1)), position(std::min(i + 2, n - 1)),
                                     position(std::min(i + 3, n - 1))});
    return static_cast<std::uint32_t>(column);
  };
  add(mPlaces.size(), [&](std::size_t i) { return mPlaces[i]; });
  const std::size_t ofPlaces = points.size();
  const std::uint32_t firstRim = add(mRim.size(), [&](std::size_t i) { return mFaces.position(mRim[i]); });
  for (OwnTriangle& own : mOwn)
    for (int k = 0; k < 3; ++k) own.point[k] += k == own.moving ? 0 : firstRim;
  mColumns = 4 * points.size();
  mSides.resize(mFixed.size() * mColumns);
  mOfPlaces.resize(mFixed.size());
  forEachBatch(bestSimdLevel(), mFixed.size(), [&](std::size_t i) {
    Sides* to = &mSides[mColumns * i];
    for (std::size_t k = 0; k < points.size(); ++k, to += 4) {
      const std::array<Sides, 4> sides = mFixed[i].plane.sides(points[k]);
      std::copy(sides.begin(), sides.end(), to);
      if (k < ofPlaces) mOfPlaces[i] = mOfPlaces[i] | all(sides);
    }
  });
}

void VertexTrial::addNear(OwnTriangle& own, const Float4Box& places) {
  Float4Box box = own.box;
  if (own.moving >= 0) box.add(places);
  own.firstNear = mNear.size();
  for (std::size_t i = 0; i < mFixed.size(); ++i) {
    const FilteredTriangle& other = mFixed[i];
    if (box.apartFrom(other.box)) continue;
    const NearTriangle near{static_cast<std::uint32_t>(i), notAmong(other.vertices, own.vertices)};
    // Wherever the vertex is, all may be on one side.
    Sides together = own.moving >= 0 ? mOfPlaces[i] : Sides{};
    for (int k = 0; k < 3; ++k)
      if (k != own.moving) together = together | (mSides[mColumns * i + own.point[k]] & near.ownMask[k]);
    if (!together.same()) mNear.push_back(near);
  }
  own.endNear = mNear.size();
}

inline void VertexTrial::move(const OwnPiece& piece, std::size_t place) {
  for (OwnTriangle& own : triangles(piece)) {
    if (own.moving < 0) continue;
    TriangleCorners corners = own.corners;
    corners[own.moving] = mPlaces[place];
    static_cast<FilteredTriangle&>(own) = {own.vertices, corners};
    own.point[own.moving] = static_cast<std::uint32_t>(place);
  }
}

std::size_t VertexTrial::countConflicts(std::size_t place, std::size_t most) {
  std::size_t count = 0;
  withSimd(bestSimdLevel(), [&] {
    for (std::size_t i = 0; i < mOrder.size() && count < most; ++i) {
      OwnPiece& piece = mPieces[mOrder[i]];
      move(piece, place);
      piece.conflicts = countPiece(i, most - count);
      count += piece.conflicts;
    }
  });
  // What has conflicts at one place is likely to have some at the next: `most` is reached sooner.
  const auto before = [this](std::size_t a, std::size_t b) { return mPieces[a].conflicts > mPieces[b].conflicts; };
  for (auto it = mOrder.begin(); it != mOrder.end(); ++it)
    std::rotate(std::upper_bound(mOrder.begin(), it, *it, before), it, it + 1);
  return count;
}

/// Counts the conflicts of the piece that is the i-th in order with the fixed triangles and the pieces before it.
inline std::size_t VertexTrial::countPiece(std::size_t i, std::size_t most) {
  const OwnPiece& piece = mPieces[mOrder[i]];
  const std::span<OwnTriangle> own = triangles(piece);
  for (OwnTriangle& t : own)
    // What it meets does not matter then.
    if (!facesForward(piece, t)) return 1;
  std::size_t count = 0;
  if (own.size() == 2) count += trianglesIntersect(own[0], own[1]);
  for (OwnTriangle& t : own)
    if (count < most) count += countNear(t, most - count);
  for (std::size_t j = 0; j < i; ++j)
    for (const OwnTriangle& t : own)
      for (const OwnTriangle& other : triangles(mPieces[mOrder[j]]))
        if (count < most) count += trianglesIntersect(t, other);
  return count;
}

inline bool VertexTrial::facesForward(const OwnPiece& piece, OwnTriangle& own) const {
  if (own.moving >= 0) return mFaces.facesForward(piece.forward, own.vertices, own.corners);
  if (!own.forward) own.forward = mFaces.facesForward(piece.forward, own.vertices, own.corners);
  return *own.forward;
}

inline std::size_t VertexTrial::countNear(OwnTriangle& own, std::size_t most) {
  if (own.nearCount) return std::min(*own.nearCount, most);
  const bool stays = own.moving < 0;
  std::size_t count = 0;
  for (std::size_t i = own.firstNear; i < own.endNear && (count < most || stays); ++i)
    if (meets(own, mNear[i])) std::swap(mNear[i], mNear[own.firstNear + count++]);
  if (stays) own.nearCount = count;
  return std::min(count, most);
}

inline bool VertexTrial::meets(const OwnTriangle& own, const NearTriangle& near) const {
  const Sides* sides = &mSides[mColumns * near.number];
  std::array<Sides, 3> ofOwn;
  for (int k = 0; k < 3; ++k) ofOwn[k] = sides[own.point[k]] & near.ownMask[k];
  if (all(ofOwn).same()) return false;
  const FilteredTriangle& other = mFixed[near.number];
  const std::array<Sides, 4> ofOther = own.plane.sides(quadOf(other.vertices), other.points);
  if (all(ofOther).same()) return false;
  return trianglesIntersect(own.corners, own.vertices, other.corners, other.vertices, {signs(ofOwn), signs(ofOther)});
}

}  // namespace pdc::detail
