#include "extract/conflicts/near_faces.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <array>

#include "extract/conflicts/triangle_filters.h"
#include "math/lane_loops.h"
#include "parallel/gather.h"
#include "parallel/sort_unique.h"

namespace pdc::detail {

/// The face being tested, and room to work in.
struct NearFaces::TestedFace {
  EdgeRef edge;
  std::vector<Triangle> triangles;
  std::vector<FilteredTriangle> filtered;  ///< The same triangles.
  Float4Box box;                           ///< Holds all of them.
  bool isQuad;
  FilteredQuad quad;             ///< If it is one.
  std::vector<Triangle> others;  ///< Those of another face.
  std::vector<Conflict> conflicts;
};

/// A quad near it.
struct NearFaces::OtherQuad {
  EdgeRef edge;
  FilteredQuad quad;
};

namespace {

/// Sorted edges, by their blocks.
struct BlockRuns {
  std::vector<std::int32_t> blocks;
  std::vector<std::size_t> begin;  ///< Where each block's edges begin, and the end.

  explicit BlockRuns(const std::vector<EdgeRef>& edges) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (i > 0 && edges[i].block == edges[i - 1].block) continue;
      blocks.push_back(edges[i].block);
      begin.push_back(i);
    }
    begin.push_back(edges.size());
  }
};

}  // namespace

inline void NearFaces::load(TestedFace& face, const EdgeRef& e) const {
  face.edge = e;
  face.filtered.clear();
  for (const Triangle& t : face.triangles) face.filtered.emplace_back(t, mFaces.corners(t));
  face.isQuad = face.triangles.size() == 2;
  if (face.isQuad) {
    const Triangle &t = face.triangles[0], &u = face.triangles[1];
    const Quad quad{t[0], t[1], t[2], u[2]};
    face.quad = FilteredQuad(quad, mFaces.corners(quad));
  }
  face.box = face.filtered[0].box;
  for (const FilteredTriangle& t : face.filtered) face.box.add(t.box);
}

/// Appends the conflicts of a face.
/// \param foundFrom conflicts with a face of these that comes before are left to it. Null: one conflict is enough.
inline void NearFaces::search(TestedFace& face, const FaceBoxes::About& near, const EdgeSet* foundFrom,
                              std::vector<Conflict>& out) const {
  const EdgeRef& e = face.edge;
  const Vec3d forward = mFaces.forward(e);
  for (std::size_t i = 0; i < face.filtered.size(); ++i) {
    const FilteredTriangle& t = face.filtered[i];
    if (!mFaces.facesForward(forward, t.vertices, t.corners)) return out.push_back({e, e, t.vertices, t.vertices});
    for (std::size_t j = 0; j < i; ++j)
      if (trianglesIntersect(t, face.filtered[j])) out.push_back({e, e, face.filtered[j].vertices, t.vertices});
  }
  const auto isFoundFrom = [&](const EdgeRef& other) {
    return foundFrom != nullptr && other < e && foundFrom->has(other);
  };
  const auto goOn = [&] { return foundFrom != nullptr || out.empty(); };
  if (!goOn()) return;
  near.forEach(face.box, [&](const EdgeRef& other, std::uint64_t number) {
    if (other == e || isFoundFrom(other)) return true;
    if (const Quad* quad = mFaces.quad(number)) {
      compare(face, {other, {*quad, mFaces.corners(*quad)}}, out);
    } else {
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
  if (face.isQuad && areParted(face.quad, other.quad)) return;
  const Quad& quad = other.quad.vertices;
  const std::array<Vec3f, 4>& corners = other.quad.corners;
  for (const FilteredTriangle& own : face.filtered) {
    const std::array<Sides, 4> sides = own.plane.sides(quad, other.quad.points);
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
        out.push_back({face.edge, other.edge, own.vertices, t});
    }
  }
}

std::vector<Conflict> NearFaces::findConflicts(const std::vector<EdgeRef>& active) {
  mProgress.beginRound(active.size());
  const BlockRuns runs(active);
  mBoxes.update(active, mProgress.monitor());
  mBoxes.prepare(runs.blocks, mProgress.monitor());
  tbb::enumerable_thread_specific<TestedFace> scratch;
  const EdgeSet all(mFaces.edgeCells().blockCount(), active);
  std::vector<Conflict> found = gather<Conflict>(runs.blocks.size(), [&](std::size_t r, std::vector<Conflict>& out) {
    TestedFace& face = scratch.local();
    const FaceBoxes::About near(mBoxes, runs.blocks[r]);
    for (std::size_t i = runs.begin[r]; i < runs.begin[r + 1]; ++i) {
      mProgress.advance();
      mFaces.triangles(active[i], mFaces.edgeCells().face(active[i]), face.triangles);
      withSimd(mLevel, [&] {
        load(face, active[i]);
        search(face, near, &all, out);
      });
    }
  });
  tbb::parallel_sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint8_t> NearFaces::soundWhenTurned(const std::vector<EdgeRef>& edges,
                                                     const std::vector<Quad>& turned) {
  const BlockRuns runs(edges);
  mBoxes.prepare(runs.blocks, mProgress.monitor());
  std::vector<std::uint8_t> sound(edges.size());
  tbb::enumerable_thread_specific<TestedFace> scratch;
  tbb::parallel_for(std::size_t{0}, runs.blocks.size(), [&](std::size_t r) {
    TestedFace& face = scratch.local();
    const FaceBoxes::About near(mBoxes, runs.blocks[r]);
    for (std::size_t i = runs.begin[r]; i < runs.begin[r + 1]; ++i) {
      mProgress.monitor().throwIfStopped();
      const Quad& q = turned[i];
      face.triangles = {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
      face.conflicts.clear();
      withSimd(mLevel, [&] {
        load(face, edges[i]);
        search(face, near, nullptr, face.conflicts);
      });
      sound[i] = face.conflicts.empty();
    }
  });
  return sound;
}

const FaceBoxes& NearFaces::boxesAbout(const std::vector<VertexState>& vertices, std::span<const std::size_t> numbers) {
  std::vector<std::int32_t> blocks;
  for (const std::size_t i : numbers) blocks.push_back(vertices[i].block);
  sortUnique(blocks);
  mBoxes.prepare(blocks, mProgress.monitor());
  return mBoxes;
}

}  // namespace pdc::detail
