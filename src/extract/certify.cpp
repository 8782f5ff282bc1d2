#include "extract/certify.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>

#include "extract/fans.h"
#include "extract/near_faces.h"
#include "extract/quad_rings.h"

namespace pdc::detail {
namespace {

/// Share of the way from its safe place to its free one at which a loose vertex lies, by how often it was drawn back.
constexpr std::array<float, 4> kShare{1.0F, 0.5F, 0.25F, 0.0F};
constexpr int kDrawnIn = 3;

class Certifier {
 public:
  Certifier(const HermiteSource& source, const SurfaceBlocks& blocks, const Topology& topology, const Doubts& doubts,
            Mesh& mesh)
      : mMap(source.map()),
        mRings(blocks, topology),
        mFans(source, blocks, mRings, mesh),
        mFaces(mMap, mRings, mFans, mesh),
        mLoose(doubts.vertices),
        mDrawn(doubts.vertices.size()),
        mMesh(mesh) {}

  CertifyCounts run(const Doubts& doubts, const Monitor& monitor) {
    for (const EdgeRef& e : doubts.quads) settle(e);
    std::vector<EdgeRef> active;
    for (const LooseVertex& v : mLoose) addQuadsAt(v, active);
    sortUnique(active);
    mFaces.setFarReaching(active);
    std::vector<EdgeRef> stuck;
    while (!active.empty()) {
      monitor.throwIfStopped();
      const std::vector<Offence> offences = findOffences(active);
      active.clear();
      drawBack(offences, active, stuck);
      sortUnique(active);
    }
    // What could not be answered may have been by what moved later.
    sortUnique(stuck);
    mCounts.uncertified = findOffences(stuck).size();
    mCounts.forcedDiagonals += doubts.forcedDiagonals;
    mCounts.fans = mFans.size();
    for (const std::uint8_t drawn : mDrawn) {
      mCounts.drawnIn += drawn == kDrawnIn;
      mCounts.shortened += drawn > 0 && drawn < kDrawnIn;
    }
    mFans.replaceQuads();
    return mCounts;
  }

 private:
  static void sortUnique(std::vector<EdgeRef>& edges) {
    tbb::parallel_sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }

  [[nodiscard]] static CellRef cellOf(const LooseVertex& v) {
    return {v.block, v.cell >> 6, v.cell >> 3 & 7, v.cell & 7};
  }

  void addQuadsAt(const LooseVertex& v, std::vector<EdgeRef>& quads) const {
    mRings.forEachEdge(cellOf(v), [&](const EdgeRef& e, int edge) {
      const CellRef c = cellOf(v);
      if (mRings.block(v.block).vertexAt(c.x, c.y, c.z, edge) == v.vertex) quads.push_back(e);
    });
  }

  /// Number among the loose vertices, or -1.
  [[nodiscard]] std::ptrdiff_t looseIndex(std::uint32_t vertex) const {
    const auto it = std::lower_bound(mLoose.begin(), mLoose.end(), vertex,
                                     [](const LooseVertex& l, std::uint32_t v) { return l.vertex < v; });
    return it != mLoose.end() && it->vertex == vertex ? it - mLoose.begin() : -1;
  }

  [[nodiscard]] bool movable(std::uint32_t vertex) const {
    const std::ptrdiff_t i = looseIndex(vertex);
    return i >= 0 && mDrawn[i] < kDrawnIn;
  }

  [[nodiscard]] std::vector<Offence> findOffences(const std::vector<EdgeRef>& active) const {
    tbb::enumerable_thread_specific<std::vector<Offence>> found;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, active.size(), 64), [&](const auto& range) {
      NearFaces near(mFaces);
      for (std::size_t i = range.begin(); i != range.end(); ++i) near.findOffences(active[i], active, found.local());
    });
    std::vector<Offence> all;
    for (const std::vector<Offence>& part : found) all.insert(all.end(), part.begin(), part.end());
    tbb::parallel_sort(all.begin(), all.end());
    return all;
  }

  /// Answers the offences; appends the quads that changed, and those for which nothing is left to do.
  void drawBack(const std::vector<Offence>& offences, std::vector<EdgeRef>& changed, std::vector<EdgeRef>& stuck) {
    std::vector<std::ptrdiff_t> draw;
    std::vector<const Offence*> settled;
    for (const Offence& o : offences) {
      const std::size_t before = draw.size();
      for (const Triangle& t : {o.triangle0, o.triangle1})
        for (const std::uint32_t v : t)
          if (movable(v)) draw.push_back(looseIndex(v));
      if (draw.size() == before) settled.push_back(&o);
    }
    std::sort(draw.begin(), draw.end());
    draw.erase(std::unique(draw.begin(), draw.end()), draw.end());
    std::vector<EdgeRef> moved;
    for (const std::ptrdiff_t i : draw) {
      const LooseVertex& v = mLoose[i];
      move(v, kShare[++mDrawn[i]]);
      addQuadsAt(v, moved);
    }
    sortUnique(moved);
    for (const EdgeRef& e : moved) settle(e);
    changed.insert(changed.end(), moved.begin(), moved.end());
    for (const Offence* o : settled)
      if (!harden(*o, changed)) stuck.insert(stuck.end(), {o->edge0, o->edge1});
  }

  void move(const LooseVertex& v, float share) {
    const CellRef c = cellOf(v);
    const Coord& b = mRings.blockCoord(v.block);
    const Vec3d center{kBlockSize * b[0] + c.x + 0.5, kBlockSize * b[1] + c.y + 0.5, kBlockSize * b[2] + c.z + 0.5};
    const Vec3f x = v.safe + (v.free - v.safe) * share;
    mMesh.positions[v.vertex] = vecCast<float>(mMap.position(center + vecCast<double>(x)));
  }

  /// A quad all of whose vertices are where they stay gets a diagonal that the lattice edge passes on the right sides
  /// of both triangles of, or becomes a fan.
  void settle(const EdgeRef& e) {
    if (mFans.has(e)) return;
    const Quad ring = mRings.vertices(e);
    for (const std::uint32_t v : ring)
      if (movable(v)) return;
    Quad& quad = mMesh.quads[mRings.face(e)];
    if (mFaces.passes(e, quad)) return;
    const Quad turned{quad[1], quad[2], quad[3], quad[0]};
    if (mFaces.passes(e, turned)) {
      quad = turned;
      ++mCounts.forcedDiagonals;
    } else {
      mFans.add(e);
    }
  }

  /// The last steps: fans, then split cells. \returns false if they have been taken.
  bool harden(const Offence& o, std::vector<EdgeRef>& changed) {
    bool any = false;
    for (const EdgeRef& e : {o.edge0, o.edge1}) {
      if (mFans.has(e)) continue;
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
  FaceTests mFaces;
  const std::vector<LooseVertex>& mLoose;
  std::vector<std::uint8_t> mDrawn;  ///< How often each was drawn back.
  Mesh& mMesh;
  CertifyCounts mCounts;
};

}  // namespace

CertifyCounts certify(const HermiteSource& source, const SurfaceBlocks& blocks, const Topology& topology,
                      const Doubts& doubts, Mesh& mesh, const Monitor& monitor) {
  return Certifier(source, blocks, topology, doubts, mesh).run(doubts, monitor);
}

}  // namespace pdc::detail
