#include "extract/vertex_trial.h"

#include <algorithm>
#include <utility>

namespace pdc::detail {

VertexTrial::VertexTrial(const NearFaces& near, const FaceTests& tests, const LooseVertex& vertex,
                         std::span<const Vec3f> places)
    : mNear(near), mTests(tests), mVertex(static_cast<std::uint32_t>(vertex.vertex)) {
  Vec3d low = near.latticePosition(places[0]), high = low;
  const auto widen = [&](const Vec3f& corner) {
    const Vec3d p = near.latticePosition(corner);
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  };
  for (const Vec3f& p : places) widen(p);
  std::vector<Triangle> fan;
  tests.rings().forEachEdgeAt(vertex, [&](const EdgeRef& e) {
    mEdges.push_back(e);
    for (const Vec3f& p : tests.corners(tests.rings().vertices(e))) widen(p);
  });
  for (const NearFaces::Face& face : near.facesAbout(low, high)) {
    if (const Quad* quad = tests.quad(face.number)) {
      addPiece({face.edge, *quad, tests.corners(*quad)}, places);
    } else {
      tests.triangles(face.edge, face.number, fan);
      for (const Triangle& t : fan) {
        const Quad q{t[0], t[1], t[2], t[2]};
        addPiece({face.edge, q, tests.corners(q)}, places);
      }
    }
  }
  for (OwnPiece& own : mOwn)
    for (std::size_t i = 0; i < mFixed.size(); ++i)
      if (!own.box.apartFrom(mFixed[i].box)) own.near.push_back(static_cast<std::uint32_t>(i));
}

void VertexTrial::addPiece(const Piece& piece, std::span<const Vec3f> places) {
  if (std::find(piece.vertices.begin(), piece.vertices.end(), mVertex) == piece.vertices.end())
    return mFixed.push_back(piece);
  mOwn.push_back({piece, {}, 0});
  for (const Vec3f& p : places) mOwn.back().box.add(float4(p));
}

void VertexTrial::Piece::move(std::uint32_t vertex, const Vec3f& place) {
  for (int i = 0; i < 4; ++i)
    if (vertices[i] == vertex) corners[i] = place;
  box = Box(corners);
  planes = {planeOf(0), planeOf(1)};
}

bool VertexTrial::finds(const Vec3f& place) const {
  return std::all_of(mEdges.begin(), mEdges.end(), [&](const EdgeRef& e) { return mNear.finds(e, place); });
}

std::size_t VertexTrial::countOffences(const Vec3f& place, std::size_t most) {
  for (OwnPiece& own : mOwn) own.move(mVertex, place);
  std::size_t count = 0;
  for (std::size_t i = 0; i < mOwn.size() && count < most; ++i) {
    mOwn[i].offences = countOffences(i, most - count);
    count += mOwn[i].offences;
  }
  // What offends at one place is likely to at the next: `most` is reached sooner.
  std::stable_sort(mOwn.begin(), mOwn.end(),
                   [](const OwnPiece& a, const OwnPiece& b) { return a.offences > b.offences; });
  return count;
}

/// Of one's own piece with the fixed ones and the own ones before it.
std::size_t VertexTrial::countOffences(std::size_t own, std::size_t most) {
  OwnPiece& piece = mOwn[own];
  for (int i = 0; i < piece.count; ++i)
    // What it meets then is of no matter.
    if (!mTests.facesForward(piece.edge, piece.triangle(i), piece.cornersOf(i))) return 1;
  std::size_t count = 0;
  if (piece.count == 2)
    count += trianglesIntersect(piece.cornersOf(0), piece.triangle(0), piece.cornersOf(1), piece.triangle(1));
  std::size_t met = 0;
  for (std::size_t i = 0; i < piece.near.size() && count < most; ++i) {
    const std::size_t pairs = countPairs(piece, mFixed[piece.near[i]], most - count);
    if (pairs > 0) std::swap(piece.near[i], piece.near[met++]);
    count += pairs;
  }
  for (std::size_t i = 0; i < own && count < most; ++i) count += countPairs(piece, mOwn[i], most - count);
  return count;
}

std::size_t VertexTrial::countPairs(const Piece& own, const Piece& other, std::size_t most) {
  if (own.box.apartFrom(other.box)) return 0;
  std::size_t count = 0;
  for (int i = 0; i < own.count; ++i) {
    if (own.planes[i].clears(other.vertices, other.corners)) continue;
    for (int j = 0; j < other.count && count < most; ++j) {
      const Triangle a = own.triangle(i), b = other.triangle(j);
      const TriangleCorners p = own.cornersOf(i), q = other.cornersOf(j);
      if (!own.planes[i].clears(b, q) && !other.planes[j].clears(a, p)) count += trianglesIntersect(p, a, q, b);
    }
  }
  return count;
}

}  // namespace pdc::detail
