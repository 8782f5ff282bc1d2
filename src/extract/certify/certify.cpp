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

/// Share of the way from its safe place to its free one at which a loose vertex lies, by how often it was drawn back.
/// Steps of halves cost half of the sharpness of creases.
constexpr std::array<float, 9> kShare{1, 0.9F, 0.8F, 0.7F, 0.6F, 0.5F, 0.35F, 0.2F, 0};
constexpr int kDrawnIn = static_cast<int>(kShare.size()) - 1;

/// How often vertices are put forward; with one more pass nothing gets better.
constexpr int kForwardPasses = 2;

/// Where there are more offences, or vertices off their places, faces are folded by noise: no single move helps, and
/// trying them takes long.
constexpr std::size_t kFewOffences = 200, kFacesPerOffence = 20;

class Certifier {
 public:
  Certifier(const HermiteSource& source, const SurfaceBlocks& blocks, const Topology& topology, const Doubts& doubts,
            Mesh& mesh)
      : mMap(source.map()),
        mRings(blocks, topology),
        mFans(source, blocks, mRings, mesh),
        mLoose(doubts.vertices),
        mFaces(mMap, mRings, mFans, mLoose, mesh),
        mFree(mLoose.size()),
        mDrawn(mLoose.size()),
        mCreaseMoves(mFaces, mLoose),
        mMesh(mesh) {}

  CertifyCounts run(const Doubts& doubts, const Monitor& monitor) {
    std::transform(mLoose.begin(), mLoose.end(), mFree.begin(), [](const LooseVertex& v) { return v.place; });
    mWanted = mFree;
    settle(doubts.quads);
    std::vector<EdgeRef> active = quadsAt(mLoose.size(), [](std::size_t i) { return i; });
    NearFaces near(mFaces, active);
    std::vector<EdgeRef> stuck;
    while (!active.empty()) {
      monitor.throwIfStopped();
      active = answer(near, near.findOffences(active), stuck);
    }
    for (int pass = 0; pass < kForwardPasses; ++pass) putForward(near);
    // What could not be answered may have been by what moved later.
    sortUnique(stuck);
    mCounts.uncertified = near.findOffences(stuck).size();
    mCounts.forcedDiagonals += doubts.forcedDiagonals;
    mCounts.fans = mFans.size();
    for (std::size_t i = 0; i < mLoose.size(); ++i) {
      const bool drawnIn = mLoose[i].place == mLoose[i].safe;
      mCounts.drawnIn += drawnIn;
      mCounts.shortened += !drawnIn && mLoose[i].place != mWanted[i];
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

  /// The quads at the loose vertices number(0) to number(n - 1), sorted.
  template <typename Number>
  [[nodiscard]] std::vector<EdgeRef> quadsAt(std::size_t n, Number&& number) const {
    std::vector<EdgeRef> quads = gather<EdgeRef>(n, [&](std::size_t i, std::vector<EdgeRef>& out) {
      mRings.forEachEdgeAt(mLoose[number(i)], [&](const EdgeRef& e) { out.push_back(e); });
    });
    sortUnique(quads);
    return quads;
  }

  /// Number of the vertex among the loose ones if it may still be moved, or -1.
  [[nodiscard]] std::ptrdiff_t movable(std::uint32_t vertex) const {
    const LooseVertex* loose = mFaces.loose(vertex);
    if (loose == nullptr) return -1;
    const std::ptrdiff_t i = loose - mLoose.data();
    return mDrawn[i] < kDrawnIn ? i : -1;
  }

  /// Answers the offences, each by the gentlest means left: the quad's other diagonal, moving a vertex along its
  /// crease, drawing vertices back, fans, split cells. \returns the faces that changed or wait for others to, sorted;
  /// appends those for which nothing is left to `stuck`.
  [[nodiscard]] std::vector<EdgeRef> answer(const NearFaces& near, std::vector<Offence> offences,
                                            std::vector<EdgeRef>& stuck) {
    std::vector<EdgeRef> changed = turn(near, offences);
    std::erase_if(offences, [&changed](const Offence& o) {
      return std::binary_search(changed.begin(), changed.end(), o.edge0) ||
             std::binary_search(changed.begin(), changed.end(), o.edge1);
    });
    const std::vector<EdgeRef> nearMoves = moveAlongCreases(near, offences);
    changed.insert(changed.end(), nearMoves.begin(), nearMoves.end());
    std::vector<std::size_t> draw;
    std::vector<const Offence*> settled;
    for (const Offence& o : offences) {
      const std::size_t before = draw.size();
      forEachCorner(o, [&](std::uint32_t v) {
        if (const std::ptrdiff_t i = movable(v); i >= 0) draw.push_back(static_cast<std::size_t>(i));
      });
      if (draw.size() == before) settled.push_back(&o);
    }
    sortUnique(draw);
    const std::vector<EdgeRef> moved = drawBack(draw);
    changed.insert(changed.end(), moved.begin(), moved.end());
    for (const Offence* o : settled)
      if (!harden(*o, changed)) stuck.insert(stuck.end(), {o->edge0, o->edge1});
    sortUnique(changed);
    return changed;
  }

  [[nodiscard]] bool foldedByNoise(std::size_t offences) const {
    return offences > std::max(kFewOffences, mMesh.quads.size() / kFacesPerOffence);
  }

  /// Moves vertices on creases to where their faces offend less, each a few times at most. Takes the offences beside
  /// them out of the list: they wait for the next round. \returns the faces that changed and those that wait.
  std::vector<EdgeRef> moveAlongCreases(const NearFaces& near, std::vector<Offence>& offences) {
    if (foldedByNoise(offences.size())) return {};
    const std::vector<CreaseMove> moves =
        mCreaseMoves.find(near, offences, [this](std::uint32_t v) { return movable(v); });
    for (const CreaseMove& m : moves) {
      mFree[m.loose] = m.place;
      mDrawn[m.loose] = 0;
      place(mLoose[m.loose], m.place);
    }
    std::vector<EdgeRef> changed = quadsAt(moves.size(), [&](std::size_t i) { return moves[i].loose; });
    settle(changed);
    std::vector<std::uint32_t> corners;
    for (const EdgeRef& e : changed)
      for (const std::uint32_t v : mRings.vertices(e)) corners.push_back(v);
    sortUnique(corners);
    std::erase_if(offences, [&](const Offence& o) {
      bool waits = false;
      forEachCorner(o,
                    [&](std::uint32_t v) { waits = waits || std::binary_search(corners.begin(), corners.end(), v); });
      if (waits) changed.insert(changed.end(), {o.edge0, o.edge1});
      return waits;
    });
    return changed;
  }

  /// Puts loose vertices on creases to better places, where their faces meet none now that all others have come to
  /// rest; those that get into each other's way go back.
  void putForward(NearFaces& near) {
    std::vector<std::size_t> vertices;
    for (std::size_t i = 0; i < mLoose.size(); ++i)
      if (mLoose[i].place != mWanted[i]) vertices.push_back(i);
    if (foldedByNoise(vertices.size())) return;
    std::vector<CreaseMove> moves = mCreaseMoves.findBetter(near, vertices, mWanted);
    for (CreaseMove& m : moves) {
      const Vec3f before = mLoose[m.loose].place;
      place(mLoose[m.loose], m.place);
      m.place = before;
    }
    std::vector<EdgeRef> changed = quadsAt(moves.size(), [&](std::size_t i) { return moves[i].loose; });
    while (!changed.empty()) {
      std::vector<std::uint32_t> corners;
      for (const Offence& o : near.findOffences(changed))
        forEachCorner(o, [&](std::uint32_t v) { corners.push_back(v); });
      sortUnique(corners);
      const auto back = std::stable_partition(moves.begin(), moves.end(), [&](const CreaseMove& m) {
        return !std::binary_search(corners.begin(), corners.end(), mLoose[m.loose].vertex);
      });
      for (auto m = back; m != moves.end(); ++m) place(mLoose[m->loose], m->place);
      changed = quadsAt(static_cast<std::size_t>(moves.end() - back),
                        [&](std::size_t i) { return back[static_cast<std::ptrdiff_t>(i)].loose; });
      moves.erase(back, moves.end());
    }
  }

  /// Turns the diagonals of offending quads where that leaves no offence, at most once each. \returns those turned,
  /// sorted.
  std::vector<EdgeRef> turn(const NearFaces& near, const std::vector<Offence>& offences) {
    std::vector<EdgeRef> edges;
    for (const Offence& o : offences)
      for (const EdgeRef& e : {o.edge0, o.edge1})
        if (!mFans.has(mRings.face(e)) && !std::binary_search(mTurned.begin(), mTurned.end(), e)) edges.push_back(e);
    sortUnique(edges);
    // Where all vertices stay, the diagonal has been chosen for good.
    std::erase_if(edges, [this](const EdgeRef& e) { return stays(mRings.vertices(e)); });
    std::vector<Quad> quads;
    for (const EdgeRef& e : edges) quads.push_back(turned(mMesh.quads[mRings.face(e)]));
    const std::vector<std::uint8_t> sound = near.soundWhenTurned(edges, quads);
    std::vector<EdgeRef> done;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (sound[i] == 0) continue;
      mMesh.quads[mRings.face(edges[i])] = quads[i];
      ++mCounts.forcedDiagonals;
      done.push_back(edges[i]);
    }
    mTurned.insert(mTurned.end(), done.begin(), done.end());
    std::sort(mTurned.begin(), mTurned.end());
    return done;
  }

  static Quad turned(const Quad& q) { return {q[1], q[2], q[3], q[0]}; }

  /// Draws loose vertices back by one step. \returns the quads at them, sorted.
  std::vector<EdgeRef> drawBack(const std::vector<std::size_t>& vertices) {
    tbb::parallel_for(std::size_t{0}, vertices.size(), [&](std::size_t i) {
      const std::size_t k = vertices[i];
      LooseVertex& v = mLoose[k];
      place(v, v.safe + (mFree[k] - v.safe) * kShare[++mDrawn[k]]);
    });
    std::vector<EdgeRef> moved = quadsAt(vertices.size(), [&](std::size_t i) { return vertices[i]; });
    settle(moved);
    return moved;
  }

  void place(LooseVertex& v, const Vec3f& x) {
    v.place = x;
    mMesh.positions[v.vertex] = mFaces.worldPosition(v, x);
  }

  [[nodiscard]] bool stays(const Quad& ring) const {
    return std::none_of(ring.begin(), ring.end(), [this](std::uint32_t v) { return movable(v) >= 0; });
  }

  /// Quads all of whose vertices are where they stay get a diagonal both of whose triangles the lattice edge passes in
  /// the right direction, or become fans.
  void settle(const std::vector<EdgeRef>& edges) {
    const std::vector<EdgeRef> fans = gather<EdgeRef>(edges.size(), [&](std::size_t i, std::vector<EdgeRef>& out) {
      const EdgeRef& e = edges[i];
      const std::uint64_t face = mRings.face(e);
      if (mFans.has(face) || !stays(mRings.vertices(e))) return;
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
  bool harden(const Offence& o, std::vector<EdgeRef>& changed) {
    bool any = false;
    for (const EdgeRef& e : {o.edge0, o.edge1}) {
      if (mFans.has(mRings.face(e))) continue;
      mFans.add(e);
      changed.push_back(e);
      any = true;
    }
    if (any) return true;
    for (const EdgeRef& e : {o.edge0, o.edge1})
      for (const CellRef& c : mRings.cells(e))
        if (kCellTable[mRings.code(c)].strict) any = mFans.split(c, changed) || any;
    return any;
  }

  const LatticeMap& mMap;
  QuadRings mRings;
  Fans mFans;
  std::vector<LooseVertex> mLoose;
  FaceTests mFaces;
  std::vector<Vec3f> mWanted;        ///< By loose vertex: where its quadric wants it.
  std::vector<Vec3f> mFree;          ///< By loose vertex: where it is drawn back from.
  std::vector<std::uint8_t> mDrawn;  ///< By loose vertex: by how many steps it was drawn back from there.
  CreaseMoves mCreaseMoves;
  std::vector<EdgeRef> mTurned;  ///< Quads whose diagonals were turned, sorted.
  tbb::combinable<std::size_t> mForced{[] { return std::size_t{0}; }};
  Mesh& mMesh;
  CertifyCounts mCounts;
};

}  // namespace

CertifyCounts certify(const HermiteSource& source, const SurfaceBlocks& blocks, const Topology& topology,
                      const Doubts& doubts, Mesh& mesh, const Monitor& monitor) {
  return Certifier(source, blocks, topology, doubts, mesh).run(doubts, monitor);
}

}  // namespace pdc::detail
