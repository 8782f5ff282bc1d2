#include "extract/certify/near_faces.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "extract/certify/triangle_filters.h"
#include "extract/vertices/vertex_solver.h"
#include "math/lane_loops.h"
#include "parallel/gather.h"

namespace pdc::detail {
namespace {

/// How far, along an axis, a face may reach from the low end of its lattice edge: with vertices in their cells, and
/// with free ones.
constexpr double kCellReach = 1, kFreeReach = kFreeHalfSize + 0.5;

/// Where more faces are far-reaching, lists of their neighbours would take much more room than the mesh.
constexpr std::size_t kFacesPerListed = 4;

/// The lattice points of a block that are not farther than `reach` from a box, as bits of a CellMask.
class PointMask {
 public:
  PointMask(const Vec3d& low, const Vec3d& high, double reach, const Coord& block) {
    std::array<int, 3> begin, end;
    for (int i = 0; i < 3; ++i) {
      begin[i] = std::max(static_cast<int>(std::ceil(low[i] - reach)) - kBlockSize * block[i], 0);
      end[i] = std::min(static_cast<int>(std::floor(high[i] + reach)) - kBlockSize * block[i] + 1, kBlockSize);
      if (begin[i] >= end[i]) return;
    }
    mBeginX = begin[0];
    mEndX = end[0];
    const auto upTo = [](int n) { return n == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1; };
    constexpr std::uint64_t kFirstOfEachRow = 0x0101010101010101;
    const std::uint64_t rows = kFirstOfEachRow & (upTo(8 * end[1]) ^ upTo(8 * begin[1]));
    mWord = rows * (upTo(end[2]) ^ upTo(begin[2]));
  }
  [[nodiscard]] int beginX() const { return mBeginX; }
  [[nodiscard]] int endX() const { return mEndX; }
  [[nodiscard]] std::uint64_t word(int x) const { return x >= mBeginX && x < mEndX ? mWord : 0; }

 private:
  int mBeginX = 0, mEndX = 0;
  std::uint64_t mWord = 0;
};

EdgeRef edgeAt(std::int32_t block, int axis, int x, int bit) {
  return {block, static_cast<std::uint16_t>(512 * axis + 64 * x + bit)};
}

}  // namespace

/// The face being looked at.
struct NearFaces::Scratch {
  std::vector<FilteredTriangle> own;
  Box box;  ///< Of all of them.
  std::vector<Triangle> triangles;
  std::vector<EdgeRef> edges;
  std::vector<Conflict> conflicts;
};

NearFaces::NearFaces(const FaceTests& tests, const std::vector<EdgeRef>& farReaching)
    : mTests(tests),
      mToLattice(tests.map().affine() ? inverse(tests.map().jacobian({})) : Mat3d::identity()),
      mOrigin(tests.map().affine() ? tests.map().position({}) : Vec3d{}),
      mFar(tests.edgeCells().blockCount(), farReaching),
      mReach(mFar.size(), kCellReach),
      mLargestReach(kCellReach) {
  std::vector<double> reach(farReaching.size());
  tbb::parallel_for(std::size_t{0}, reach.size(), [&](std::size_t i) { reach[i] = reachOf(farReaching[i]); });
  for (std::size_t i = 0; i < farReaching.size(); ++i) {
    double& most = mReach[mFar.place(farReaching[i].block)];
    most = std::max(most, reach[i]);
    mLargestReach = std::max(mLargestReach, reach[i]);
  }
  if (farReaching.size() > tests.edgeCells().faceCount() / kFacesPerListed) return;
  mFarFaces.resize(farReaching.size());
  tbb::enumerable_thread_specific<std::vector<EdgeRef>> edges;
  tbb::parallel_for(std::size_t{0}, farReaching.size(), [&](std::size_t i) {
    mFarFaces[i].edge = farReaching[i];
    std::vector<EdgeRef>& own = edges.local();
    withSimd(mLevel, [&] { list(mFarFaces[i], own); });
  });
}

Vec3d NearFaces::latticePosition(const Vec3f& corner) const { return mToLattice * (vecCast<double>(corner) - mOrigin); }

double NearFaces::reachOf(const EdgeRef& e) const {
  if (!mTests.map().affine()) return kFreeReach;
  const Vec3d at = mTests.edgeCells().lowEnd(e);
  double reach = 0;
  for (const Vec3f& corner : mTests.corners(mTests.edgeCells().vertices(e)))
    reach = std::max(reach, distance(at, latticePosition(corner)));
  return reach;
}

double NearFaces::distance(const Vec3d& from, const Vec3d& place) {
  const Vec3d step = place - from;
  return std::max({std::abs(step.x), std::abs(step.y), std::abs(step.z)});
}

double NearFaces::farReach(const EdgeRef& e) const { return mFar.has(e) ? mReach[mFar.place(e.block)] : -1; }

inline void NearFaces::addFacesOf(std::int32_t block, const LatticeBox& box, std::vector<EdgeRef>& out) const {
  const std::int32_t farPlace = mFar.place(block);
  const Coord& coord = mTests.edgeCells().blockCoord(block);
  const PointMask near(box.low, box.high, kCellReach, coord);
  const BlockTopology& topology = mTests.edgeCells().block(block);
  const auto add = [&](int axis, int x, std::uint64_t edges) {
    for (; edges != 0; edges &= edges - 1) out.push_back(edgeAt(block, axis, x, std::countr_zero(edges)));
  };
  if (farPlace < 0) {
    for (int axis = 0; axis < 3; ++axis)
      for (int x = near.beginX(); x < near.endX(); ++x) add(axis, x, topology.edges[axis].word[x] & near.word(x));
    return;
  }
  const PointMask far(box.low, box.high, mReach[farPlace], coord);
  for (int axis = 0; axis < 3; ++axis)
    for (int x = far.beginX(); x < far.endX(); ++x)
      add(axis, x,
          (topology.edges[axis].word[x] & near.word(x)) | (mFar.edges(farPlace, kAxes[axis]).word[x] & far.word(x)));
}

void NearFaces::facesAbout(const Box& box, std::vector<EdgeRef>& out) const { facesAbout(latticeBox(box), out); }

inline void NearFaces::facesAbout(const LatticeBox& box, std::vector<EdgeRef>& out) const {
  out.clear();
  Coord from, to;
  for (int i = 0; i < 3; ++i) {
    from[i] = static_cast<std::int32_t>(std::floor(box.low[i] - mLargestReach)) >> 3;
    to[i] = static_cast<std::int32_t>(std::floor(box.high[i] + mLargestReach)) >> 3;
  }
  for (Coord b = from; b[0] <= to[0]; ++b[0])
    for (b[1] = from[1]; b[1] <= to[1]; ++b[1])
      for (b[2] = from[2]; b[2] <= to[2]; ++b[2])
        if (const std::int32_t block = mTests.edgeCells().find(b); block != BlockIndex::kMissing)
          addFacesOf(block, box, out);
}

/// Of a face that is in a box of world space.
inline NearFaces::LatticeBox NearFaces::latticeBox(const EdgeRef& e, const Box& box) const {
  if (mTests.map().affine()) return latticeBox(box);
  const Vec3d p = mTests.edgeCells().lowEnd(e), reach{kFreeReach, kFreeReach, kFreeReach};
  return {p - reach, p + reach};
}

inline NearFaces::LatticeBox NearFaces::latticeBox(const Box& box) const {
  constexpr double kHuge = 1e300;
  LatticeBox result{{kHuge, kHuge, kHuge}, {-kHuge, -kHuge, -kHuge}};
  for (int corner = 0; corner < 8; ++corner) {
    Vec3f at;
    for (int i = 0; i < 3; ++i) at[i] = (corner >> i & 1) != 0 ? box.high[i] : box.low[i];
    const Vec3d p = latticePosition(at);
    for (int i = 0; i < 3; ++i) {
      result.low[i] = std::min(result.low[i], p[i]);
      result.high[i] = std::max(result.high[i], p[i]);
    }
  }
  return result;
}

/// Lists what is near the face wherever it is between its present and its safe place.
inline void NearFaces::list(FarFace& face, std::vector<EdgeRef>& edges) const {
  const Quad ring = mTests.edgeCells().vertices(face.edge);
  face.likely = Box(mTests.corners(ring));
  for (const std::uint32_t v : ring)
    if (const SuspectVertex* suspect = mTests.suspect(v))
      face.likely.add(float4(mTests.worldPosition(*suspect, suspect->safe)));
  facesAbout(latticeBox(face.edge, face.likely), edges);
  for (const EdgeRef& e : edges) {
    if (mFar.has(e)) {
      if (e != face.edge) face.far.push_back(static_cast<std::uint32_t>(mFar.number(e)));
    } else if (!staysApart(e, face.likely)) {
      face.others.push_back(e);
    }
  }
}

/// Whether a face whose vertices stay where they are never reaches into a box.
inline bool NearFaces::staysApart(const EdgeRef& e, const Box& box) const {
  const Quad* quad = mTests.quad(mTests.edgeCells().face(e));
  if (quad == nullptr) return false;
  Box own(mTests.corners(*quad));
  if (!own.apartFrom(box)) return false;
  // It may become a fan, about a vertex on its lattice edge.
  Vec3d end = mTests.edgeCells().lowEnd(e);
  own.add(float4(vecCast<float>(mTests.map().position(end))));
  end[e.axis()] += 1;
  own.add(float4(vecCast<float>(mTests.map().position(end))));
  own.addRounding();
  return own.apartFrom(box);
}

inline const NearFaces::FarFace* NearFaces::listed(const EdgeRef& e) const {
  return !mFarFaces.empty() && mFar.has(e) ? &mFarFaces[mFar.number(e)] : nullptr;
}

/// Calls visit(edge) for all faces that may meet the one being looked at, until it says no.
template <typename Visit>
void NearFaces::forEachNear(const EdgeRef& e, Scratch& own, Visit&& visit) const {
  const FarFace* face = listed(e);
  if (face == nullptr || !face->likely.contains(own.box)) {
    facesAbout(latticeBox(e, own.box), own.edges);
    for (const EdgeRef& other : own.edges)
      if (other != e && !visit(other)) return;
    return;
  }
  for (const std::uint32_t i : face->far)
    if (const FarFace& other = mFarFaces[i]; !own.box.apartFrom(other.now) && !visit(other.edge)) return;
  for (const EdgeRef& other : face->others)
    if (!visit(other)) return;
}

inline void NearFaces::load(Scratch& own, const std::vector<Triangle>& triangles) const {
  own.own.clear();
  for (const Triangle& t : triangles) own.own.emplace_back(t, mTests.corners(t));
  own.box = own.own[0].box;
  for (const FilteredTriangle& t : own.own) own.box.add(t.box);
}

inline void NearFaces::search(const EdgeRef& e, Scratch& own, const EdgeSet* foundFrom,
                              std::vector<Conflict>& out) const {
  for (std::size_t i = 0; i < own.own.size(); ++i) {
    const FilteredTriangle& t = own.own[i];
    if (!mTests.facesForward(e, t.vertices, t.corners)) return out.push_back({e, e, t.vertices, t.vertices});
    for (std::size_t j = 0; j < i; ++j)
      if (trianglesIntersect(t, own.own[j])) out.push_back({e, e, own.own[j].vertices, t.vertices});
  }
  const auto isFoundFrom = [&](const EdgeRef& other) {
    return foundFrom != nullptr && other < e && foundFrom->has(other);
  };
  const auto goOn = [&] { return foundFrom != nullptr || out.empty(); };
  if (!goOn()) return;
  forEachNear(e, own, [&](const EdgeRef& other) {
    const std::uint64_t face = mTests.edgeCells().face(other);
    if (const Quad* quad = mTests.quad(face)) {
      const std::array<Vec3f, 4> corners = mTests.corners(*quad);
      if (own.box.apartFrom(Box(corners)) || isFoundFrom(other)) return true;
      compare(e, own, other, *quad, corners, out);
    } else if (!isFoundFrom(other)) {
      mTests.triangles(other, face, own.triangles);
      for (const Triangle& t : own.triangles)
        for (const FilteredTriangle& o : own.own)
          if (trianglesIntersect(o, {t, mTests.corners(t)})) out.push_back({e, other, o.vertices, t});
    }
    return goOn();
  });
}

/// The triangles of the face in `own` with those of a quad.
inline void NearFaces::compare(const EdgeRef& e, const Scratch& own, const EdgeRef& other, const Quad& quad,
                               const std::array<Vec3f, 4>& corners, std::vector<Conflict>& out) const {
  const Points points(corners);
  for (const FilteredTriangle& o : own.own) {
    const std::array<Sides, 4> sides = o.plane.sides(quad, points);
    // Nearly always all of the quad is on one side.
    if (all(sides).same()) continue;
    for (int j = 1; j < 3; ++j) {
      const std::array<Sides, 3> tSides{sides[0], sides[j], sides[j + 1]};
      if (all(tSides).same()) continue;
      const Triangle t{quad[0], quad[j], quad[j + 1]};
      const TriangleCorners tCorners{corners[0], corners[j], corners[j + 1]};
      const std::array<Sides, 4> oSides = TrianglePlane(t, tCorners).sides(quadOf(o.vertices), o.points);
      if (all(oSides).same()) continue;
      if (trianglesIntersect(o.corners, o.vertices, tCorners, t, {signs(oSides), signs(tSides)}))
        out.push_back({e, other, o.vertices, t});
    }
  }
}

inline void NearFaces::updateBox(FarFace& face, Scratch& own) const {
  const std::uint64_t number = mTests.edgeCells().face(face.edge);
  if (const Quad* quad = mTests.quad(number)) {
    face.now = Box(mTests.corners(*quad));
    return;
  }
  mTests.triangles(face.edge, number, own.triangles);
  face.now = Box(mTests.corners(own.triangles[0]));
  for (const Triangle& t : own.triangles) face.now.add(Box(mTests.corners(t)));
}

std::vector<Conflict> NearFaces::findConflicts(const std::vector<EdgeRef>& active) {
  tbb::enumerable_thread_specific<Scratch> scratch;
  tbb::parallel_for(std::size_t{0}, active.size(), [&](std::size_t i) {
    if (!mFarFaces.empty() && mFar.has(active[i])) updateBox(mFarFaces[mFar.number(active[i])], scratch.local());
  });
  const EdgeSet all(mTests.edgeCells().blockCount(), active);
  std::vector<Conflict> found = gather<Conflict>(active.size(), [&](std::size_t i, std::vector<Conflict>& out) {
    Scratch& own = scratch.local();
    mTests.triangles(active[i], mTests.edgeCells().face(active[i]), own.triangles);
    withSimd(mLevel, [&] {
      load(own, own.triangles);
      search(active[i], own, &all, out);
    });
  });
  tbb::parallel_sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint8_t> NearFaces::soundWhenTurned(const std::vector<EdgeRef>& edges,
                                                     const std::vector<Quad>& turned) const {
  std::vector<std::uint8_t> sound(edges.size());
  tbb::enumerable_thread_specific<Scratch> scratch;
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) {
    Scratch& own = scratch.local();
    const Quad& q = turned[i];
    own.triangles = {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
    own.conflicts.clear();
    withSimd(mLevel, [&] {
      load(own, own.triangles);
      search(edges[i], own, nullptr, own.conflicts);
    });
    sound[i] = own.conflicts.empty();
  });
  return sound;
}

}  // namespace pdc::detail
