#include "extract/certify/certify.h"

#include <tbb/combinable.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <functional>

#include "extract/certify/crease_moves.h"
#include "extract/certify/fans.h"
#include "extract/certify/near_faces.h"
#include "extract/topology/edge_cells.h"
#include "parallel/gather.h"

namespace pdc::detail {
namespace {

/// Share of the way from its safe place to its free one at which a suspect vertex lies, by how often it was drawn back.
/// Steps of halves cost half of the sharpness of creases.
constexpr std::array<float, 9> kShare{1, 0.9F, 0.8F, 0.7F, 0.6F, 0.5F, 0.35F, 0.2F, 0};
constexpr int kDrawnIn = static_cast<int>(kShare.size()) - 1;

/// How often vertices are put forward; with one more pass nothing gets better.
constexpr int kForwardPasses = 2;

/// Where there are more conflicts, or vertices off their places, faces are folded by noise: no single move helps, and
/// trying them takes long.
constexpr std::size_t kFewConflicts = 200, kFacesPerConflict = 20;

class Certifier {
 public:
  Certifier(const Surface& surface, const Suspects& suspects, Mesh& mesh)
      : mMap(surface.source.map()),
        mEdgeCells(surface.blocks, surface.topology),
        mFans(surface.source, surface.blocks, mEdgeCells, mesh),
        mSuspects(suspects.vertices),
        mFaces(mMap, mEdgeCells, mFans, mSuspects, mesh),
        mFree(mSuspects.size()),
        mDrawn(mSuspects.size()),
        mCreaseMoves(mFaces, mSuspects),
        mMesh(mesh) {}

  CertifyCounts run(const Suspects& suspects, const Monitor& monitor) {
    std::transform(mSuspects.begin(), mSuspects.end(), mFree.begin(), [](const SuspectVertex& v) { return v.place; });
    mWanted = mFree;
    chooseSafeDiagonals(suspects.quads);
    std::vector<EdgeRef> active = quadsAt(mSuspects.size(), [](std::size_t i) { return i; });
    NearFaces near(mFaces, active);
    std::vector<EdgeRef> stuck;
    while (!active.empty()) {
      monitor.throwIfStopped();
      active = answer(near, near.findConflicts(active), stuck);
    }
    for (int pass = 0; pass < kForwardPasses; ++pass) putForward(near);
    // What could not be answered may have been by what moved later.
    sortUnique(stuck);
    mCounts.uncertified = near.findConflicts(stuck).size();
    mCounts.forcedDiagonals += suspects.forcedDiagonals;
    mCounts.fans = mFans.size();
    for (std::size_t i = 0; i < mSuspects.size(); ++i) {
      const bool drawnIn = mSuspects[i].place == mSuspects[i].safe;
      mCounts.drawnIn += drawnIn;
      mCounts.shortened += !drawnIn && mSuspects[i].place != mWanted[i];
    }
    mCounts.addedBoundaryEdges = mFans.replaceQuads();
    return mCounts;
  }

 private:
  template <typename T>
  static void sortUnique(std::vector<T>& list) {
    tbb::parallel_sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  /// The quads at the suspect vertices number(0) to number(n - 1), sorted.
  template <typename Number>
  [[nodiscard]] std::vector<EdgeRef> quadsAt(std::size_t n, Number&& number) const {
    std::vector<EdgeRef> quads = gather<EdgeRef>(n, [&](std::size_t i, std::vector<EdgeRef>& out) {
      mEdgeCells.forEachEdgeAt(mSuspects[number(i)], [&](const EdgeRef& e) { out.push_back(e); });
    });
    sortUnique(quads);
    return quads;
  }

  /// Number of the vertex among the suspect ones if it may still be moved, or -1.
  [[nodiscard]] std::ptrdiff_t movable(std::uint32_t vertex) const {
    const SuspectVertex* suspect = mFaces.suspect(vertex);
    if (suspect == nullptr) return -1;
    const std::ptrdiff_t i = suspect - mSuspects.data();
    return mDrawn[i] < kDrawnIn ? i : -1;
  }

  /// Answers the conflicts, each by the gentlest means left: the quad's other diagonal, moving a vertex along its
  /// crease, drawing vertices back, fans, split cells. \returns the faces that changed or wait for others to, sorted;
  /// appends those for which nothing is left to `stuck`.
  [[nodiscard]] std::vector<EdgeRef> answer(const NearFaces& near, std::vector<Conflict> conflicts,
                                            std::vector<EdgeRef>& stuck) {
    std::vector<EdgeRef> changed = turn(near, conflicts);
    std::erase_if(conflicts, [&changed](const Conflict& o) {
      return std::binary_search(changed.begin(), changed.end(), o.edge0) ||
             std::binary_search(changed.begin(), changed.end(), o.edge1);
    });
    const std::vector<EdgeRef> nearMoves = moveAlongCreases(near, conflicts);
    changed.insert(changed.end(), nearMoves.begin(), nearMoves.end());
    std::vector<std::size_t> draw;
    std::vector<const Conflict*> resting;
    for (const Conflict& o : conflicts) {
      const std::size_t before = draw.size();
      forEachCorner(o, [&](std::uint32_t v) {
        if (const std::ptrdiff_t i = movable(v); i >= 0) draw.push_back(static_cast<std::size_t>(i));
      });
      if (draw.size() == before) resting.push_back(&o);
    }
    sortUnique(draw);
    const std::vector<EdgeRef> moved = drawBack(draw);
    changed.insert(changed.end(), moved.begin(), moved.end());
    for (const Conflict* o : resting)
      if (!subdivide(*o, changed)) stuck.insert(stuck.end(), {o->edge0, o->edge1});
    sortUnique(changed);
    return changed;
  }

  [[nodiscard]] bool foldedByNoise(std::size_t conflicts) const {
    return conflicts > std::max(kFewConflicts, mMesh.quads.size() / kFacesPerConflict);
  }

  /// Moves vertices on creases to where their faces have fewer conflicts, each a few times at most. Takes the conflicts
  /// beside them out of the list: they wait for the next round. \returns the faces that changed and those that wait.
  std::vector<EdgeRef> moveAlongCreases(const NearFaces& near, std::vector<Conflict>& conflicts) {
    if (foldedByNoise(conflicts.size())) return {};
    const std::vector<CreaseMove> moves =
        mCreaseMoves.find(near, conflicts, [this](std::uint32_t v) { return movable(v); });
    for (const CreaseMove& m : moves) {
      mFree[m.suspect] = m.place;
      mDrawn[m.suspect] = 0;
      place(mSuspects[m.suspect], m.place);
    }
    std::vector<EdgeRef> changed = quadsAt(moves.size(), [&](std::size_t i) { return moves[i].suspect; });
    chooseSafeDiagonals(changed);
    std::vector<std::uint32_t> corners;
    for (const EdgeRef& e : changed)
      for (const std::uint32_t v : mEdgeCells.vertices(e)) corners.push_back(v);
    sortUnique(corners);
    std::erase_if(conflicts, [&](const Conflict& o) {
      bool waits = false;
      forEachCorner(o,
                    [&](std::uint32_t v) { waits = waits || std::binary_search(corners.begin(), corners.end(), v); });
      if (waits) changed.insert(changed.end(), {o.edge0, o.edge1});
      return waits;
    });
    return changed;
  }

  /// Puts suspect vertices on creases to better places, where their faces meet none now that all others have come to
  /// rest; those that get into each other's way go back.
  void putForward(NearFaces& near) {
    std::vector<std::size_t> vertices;
    for (std::size_t i = 0; i < mSuspects.size(); ++i)
      if (mSuspects[i].place != mWanted[i]) vertices.push_back(i);
    if (foldedByNoise(vertices.size())) return;
    std::vector<CreaseMove> moves = mCreaseMoves.findBetter(near, vertices, mWanted);
    for (CreaseMove& m : moves) {
      const Vec3f before = mSuspects[m.suspect].place;
      place(mSuspects[m.suspect], m.place);
      m.place = before;
    }
    std::vector<EdgeRef> changed = quadsAt(moves.size(), [&](std::size_t i) { return moves[i].suspect; });
    while (!changed.empty()) {
      std::vector<std::uint32_t> corners;
      for (const Conflict& o : near.findConflicts(changed))
        forEachCorner(o, [&](std::uint32_t v) { corners.push_back(v); });
      sortUnique(corners);
      const auto back = std::stable_partition(moves.begin(), moves.end(), [&](const CreaseMove& m) {
        return !std::binary_search(corners.begin(), corners.end(), mSuspects[m.suspect].vertex);
      });
      for (auto m = back; m != moves.end(); ++m) place(mSuspects[m->suspect], m->place);
      changed = quadsAt(static_cast<std::size_t>(moves.end() - back),
                        [&](std::size_t i) { return back[static_cast<std::ptrdiff_t>(i)].suspect; });
      moves.erase(back, moves.end());
    }
  }

  /// Turns the diagonals of conflicting quads where that leaves no conflict, at most once each. \returns those turned,
  /// sorted.
  std::vector<EdgeRef> turn(const NearFaces& near, const std::vector<Conflict>& conflicts) {
    std::vector<EdgeRef> edges;
    for (const Conflict& o : conflicts)
      for (const EdgeRef& e : {o.edge0, o.edge1})
        if (!mFans.has(mEdgeCells.face(e)) && !std::binary_search(mTurned.begin(), mTurned.end(), e))
          edges.push_back(e);
    sortUnique(edges);
    // Where all vertices stay, the diagonal has been chosen for good.
    std::erase_if(edges, [this](const EdgeRef& e) { return stays(mEdgeCells.vertices(e)); });
    std::vector<Quad> quads;
    for (const EdgeRef& e : edges) quads.push_back(turned(mMesh.quads[mEdgeCells.face(e)]));
    const std::vector<std::uint8_t> sound = near.soundWhenTurned(edges, quads);
    std::vector<EdgeRef> done;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (sound[i] == 0) continue;
      mMesh.quads[mEdgeCells.face(edges[i])] = quads[i];
      ++mCounts.forcedDiagonals;
      done.push_back(edges[i]);
    }
    mTurned.insert(mTurned.end(), done.begin(), done.end());
    std::sort(mTurned.begin(), mTurned.end());
    return done;
  }

  static Quad turned(const Quad& q) { return {q[1], q[2], q[3], q[0]}; }

  /// Draws suspect vertices back by one step. \returns the quads at them, sorted.
  std::vector<EdgeRef> drawBack(const std::vector<std::size_t>& vertices) {
    tbb::parallel_for(std::size_t{0}, vertices.size(), [&](std::size_t i) {
      const std::size_t k = vertices[i];
      SuspectVertex& v = mSuspects[k];
      place(v, v.safe + (mFree[k] - v.safe) * kShare[++mDrawn[k]]);
    });
    std::vector<EdgeRef> moved = quadsAt(vertices.size(), [&](std::size_t i) { return vertices[i]; });
    chooseSafeDiagonals(moved);
    return moved;
  }

  void place(SuspectVertex& v, const Vec3f& x) {
    v.place = x;
    mMesh.positions[v.vertex] = mFaces.worldPosition(v, x);
  }

  [[nodiscard]] bool stays(const Quad& ring) const {
    return std::none_of(ring.begin(), ring.end(), [this](std::uint32_t v) { return movable(v) >= 0; });
  }

  /// Quads all of whose vertices are where they stay get a diagonal both of whose triangles the lattice edge passes in
  /// the right direction, or become fans.
  void chooseSafeDiagonals(const std::vector<EdgeRef>& edges) {
    const std::vector<EdgeRef> fans = gather<EdgeRef>(edges.size(), [&](std::size_t i, std::vector<EdgeRef>& out) {
      const EdgeRef& e = edges[i];
      const std::uint64_t face = mEdgeCells.face(e);
      if (mFans.has(face) || !stays(mEdgeCells.vertices(e))) return;
      Quad& quad = mMesh.quads[face];
      if (mFaces.passes(e, quad)) return;
      if (!mFaces.passes(e, turned(quad))) return out.push_back(e);
      quad = turned(quad);
      ++mForced.local();
    });
    for (const EdgeRef& e : fans) mFans.add(e);
    mCounts.forcedDiagonals += mForced.combine(std::plus<>());
    mForced.clear();
  }

  /// The last steps: fans, then split cells. \returns false if they have been taken.
  bool subdivide(const Conflict& o, std::vector<EdgeRef>& changed) {
    bool any = false;
    for (const EdgeRef& e : {o.edge0, o.edge1}) {
      if (mFans.has(mEdgeCells.face(e))) continue;
      mFans.add(e);
      changed.push_back(e);
      any = true;
    }
    if (any) return true;
    for (const EdgeRef& e : {o.edge0, o.edge1})
      for (const CellRef& c : mEdgeCells.cells(e))
        if (kCellTable[mEdgeCells.code(c)].ambiguous) any = mFans.split(c, changed) || any;
    return any;
  }

  const LatticeMap& mMap;
  EdgeCells mEdgeCells;
  Fans mFans;
  std::vector<SuspectVertex> mSuspects;
  FaceTests mFaces;
  std::vector<Vec3f> mWanted;        ///< By suspect vertex: where its quadric wants it.
  std::vector<Vec3f> mFree;          ///< By suspect vertex: where it is drawn back from.
  std::vector<std::uint8_t> mDrawn;  ///< By suspect vertex: by how many steps it was drawn back from there.
  CreaseMoves mCreaseMoves;
  std::vector<EdgeRef> mTurned;  ///< Quads whose diagonals were turned, sorted.
  tbb::combinable<std::size_t> mForced{[] { return std::size_t{0}; }};
  Mesh& mMesh;
  CertifyCounts mCounts;
};

}  // namespace

CertifyCounts certify(const Surface& surface, const Suspects& suspects, Mesh& mesh, const Monitor& monitor) {
  return Certifier(surface, suspects, mesh).run(suspects, monitor);
}

}  // namespace pdc::detail
