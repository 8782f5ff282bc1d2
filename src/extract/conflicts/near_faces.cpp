#include "extract/conflicts/near_faces.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <array>

#include "extract/conflicts/triangle_filters.h"
#include "math/lane_loops.h"
#include "parallel/gather.h"

namespace pdc::detail {

/// The face being tested, and room to work in.
struct NearFaces::TestedFace {
  EdgeRef edge;
  std::vector<Triangle> triangles;
  std::vector<FilteredTriangle> filtered;  ///< The same triangles.
  Float4Box box;                           ///< Holds all of them.
  std::vector<EdgeRef> near;
  std::vector<Triangle> others;  ///< Those of another face.
  std::vector<Conflict> conflicts;
};

/// A quad near it.
struct NearFaces::OtherQuad {
  EdgeRef edge;
  const Quad& vertices;
  const std::array<Vec3f, 4>& corners;
};

NearFaces::NearFaces(const FaceTests& faces, const std::vector<EdgeRef>& farReaching, RoundProgress& progress,
                     SimdLevel level)
    : mFaces(faces),
      mProgress(progress),
      mLevel(level),
      mLocator(faces, farReaching, progress.monitor()),
      mFarFaces(faces, mLocator, farReaching, level, progress.monitor()) {}

/// Calls visit(edge), until it returns false, for all other faces that may meet the one being tested.
template <typename Visit>
void NearFaces::forEachNear(TestedFace& face, Visit&& visit) const {
  if (mFarFaces.forEachNear(face.edge, face.box, visit)) return;
  mLocator.facesAbout(mLocator.latticeBox(face.edge, face.box), face.near);
  for (const EdgeRef& other : face.near)
    if (other != face.edge && !visit(other)) return;
}

inline void NearFaces::load(TestedFace& face, const EdgeRef& e) const {
  face.edge = e;
  face.filtered.clear();
  for (const Triangle& t : face.triangles) face.filtered.emplace_back(t, mFaces.corners(t));
  face.box = face.filtered[0].box;
  for (const FilteredTriangle& t : face.filtered) face.box.add(t.box);
}

/// Appends the conflicts of a face.
/// \param foundFrom conflicts with a face of these that comes before are left to it. Null: one conflict is enough.
inline void NearFaces::search(TestedFace& face, const EdgeSet* foundFrom, std::vector<Conflict>& out) const {
  const EdgeRef& e = face.edge;
  for (std::size_t i = 0; i < face.filtered.size(); ++i) {
    const FilteredTriangle& t = face.filtered[i];
    if (!mFaces.facesForward(e, t.vertices, t.corners)) return out.push_back({e, e, t.vertices, t.vertices});
    for (std::size_t j = 0; j < i; ++j)
      if (trianglesIntersect(t, face.filtered[j])) out.push_back({e, e, face.filtered[j].vertices, t.vertices});
  }
  const auto isFoundFrom = [&](const EdgeRef& other) {
    return foundFrom != nullptr && other < e && foundFrom->has(other);
  };
  const auto goOn = [&] { return foundFrom != nullptr || out.empty(); };
  if (!goOn()) return;
  forEachNear(face, [&](const EdgeRef& other) {
    const std::uint64_t number = mFaces.edgeCells().face(other);
    if (const Quad* quad = mFaces.quad(number)) {
      const std::array<Vec3f, 4> corners = mFaces.corners(*quad);
      if (face.box.apartFrom(Float4Box(corners)) || isFoundFrom(other)) return true;
      compare(face, {other, *quad, corners}, out);
    } else if (!isFoundFrom(other)) {
      mFaces.triangles(other, number, face.others);
      for (const Triangle& t : face.others)
        for (const FilteredTriangle& own : face.filtered)
          if (trianglesIntersect(own, {t, mFaces.corners(t)})) out.push_back({e, other, own.vertices, t});
    }
    return goOn();
  });
}

/// Appends the conflicts of a face with a quad.
inline void NearFaces::compare(const TestedFace& face, const OtherQuad& other, std::vector<Conflict>& out) {
  const auto& [edge, quad, corners] = other;
  const Points points(corners);
  for (const FilteredTriangle& own : face.filtered) {
    const std::array<Sides, 4> sides = own.plane.sides(quad, points);
    // Nearly always all of the quad is on one side.
    if (all(sides).same()) continue;
    for (int j = 1; j < 3; ++j) {
      const std::array<Sides, 3> tSides{sides[0], sides[j], sides[j + 1]};
      if (all(tSides).same()) continue;
      const Triangle t{quad[0], quad[j], quad[j + 1]};
      const TriangleCorners tCorners{corners[0], corners[j], corners[j + 1]};
      const std::array<Sides, 4> ownSides = TrianglePlane(t, tCorners).sides(quadOf(own.vertices), own.points);
      if (all(ownSides).same()) continue;
      if (trianglesIntersect(own.corners, own.vertices, tCorners, t, {signs(ownSides), signs(tSides)}))
        out.push_back({face.edge, edge, own.vertices, t});
    }
  }
}

std::vector<Conflict> NearFaces::findConflicts(const std::vector<EdgeRef>& active) {
  mProgress.beginRound(active.size());
  tbb::enumerable_thread_specific<TestedFace> scratch;
  tbb::parallel_for(std::size_t{0}, active.size(), [&](std::size_t i) {
    mProgress.monitor().throwIfStopped();
    mFarFaces.update(active[i], scratch.local().triangles);
  });
  const EdgeSet all(mFaces.edgeCells().blockCount(), active);
  std::vector<Conflict> found = gather<Conflict>(active.size(), [&](std::size_t i, std::vector<Conflict>& out) {
    mProgress.advance();
    TestedFace& face = scratch.local();
    mFaces.triangles(active[i], mFaces.edgeCells().face(active[i]), face.triangles);
    withSimd(mLevel, [&] {
      load(face, active[i]);
      search(face, &all, out);
    });
  });
  tbb::parallel_sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint8_t> NearFaces::soundWhenTurned(const std::vector<EdgeRef>& edges,
                                                     const std::vector<Quad>& turned) const {
  std::vector<std::uint8_t> sound(edges.size());
  tbb::enumerable_thread_specific<TestedFace> scratch;
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) {
    mProgress.monitor().throwIfStopped();
    TestedFace& face = scratch.local();
    const Quad& q = turned[i];
    face.triangles = {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
    face.conflicts.clear();
    withSimd(mLevel, [&] {
      load(face, edges[i]);
      search(face, nullptr, face.conflicts);
    });
    sound[i] = face.conflicts.empty();
  });
  return sound;
}

}  // namespace pdc::detail
