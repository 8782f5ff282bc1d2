#include "extract/near_faces.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "extract/gather.h"
#include "extract/triangle_filters.h"
#include "extract/vertex_solver.h"
#include "math/lane_loops.h"

namespace pdc::detail {
namespace {

/// How far, along an axis, a face may reach from the low end of its lattice edge: with vertices in their cells, and
/// with free ones.
constexpr double kCellReach = 1, kFreeReach = kFreeHalfSize + 0.5;

/// The lattice points of a block that are not farther than `reach` from a box, as bits of a CellMask.
class Window {
 public:
  Window(const Vec3d& low, const Vec3d& high, double reach, const Coord& block) {
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
  std::vector<Triangle> own, other;
  std::vector<TriangleCorners> corners;  ///< Of `own`.
  std::vector<TrianglePlane> planes;     ///< Of `own`.
};

NearFaces::NearFaces(const FaceTests& tests, const std::vector<EdgeRef>& farReaching)
    : mTests(tests),
      mToLattice(tests.map().affine() ? inverse(tests.map().jacobian({})) : Mat3d::identity()),
      mOrigin(tests.map().affine() ? tests.map().position({}) : Vec3d{}),
      mFar(tests.rings().blockCount(), farReaching),
      mReach(mFar.size(), kCellReach),
      mLargestReach(kCellReach) {
  std::vector<double> reach(farReaching.size());
  tbb::parallel_for(std::size_t{0}, reach.size(), [&](std::size_t i) { reach[i] = reachOf(farReaching[i]); });
  for (std::size_t i = 0; i < farReaching.size(); ++i) {
    double& most = mReach[mFar.place(farReaching[i].block)];
    most = std::max(most, reach[i]);
    mLargestReach = std::max(mLargestReach, reach[i]);
  }
}

Vec3d NearFaces::latticePosition(const Vec3f& corner) const { return mToLattice * (vecCast<double>(corner) - mOrigin); }

double NearFaces::reachOf(const EdgeRef& e) const {
  if (!mTests.map().affine()) return kFreeReach;
  const Coord at = mTests.rings().low(e);
  double reach = 0;
  for (const Vec3f& corner : mTests.corners(mTests.rings().vertices(e))) reach = std::max(reach, distance(at, corner));
  return reach;
}

double NearFaces::distance(const Coord& at, const Vec3f& corner) const {
  const Vec3d step = latticePosition(corner) - Vec3d{double(at[0]), double(at[1]), double(at[2])};
  return std::max({std::abs(step.x), std::abs(step.y), std::abs(step.z)});
}

bool NearFaces::finds(const EdgeRef& e, const Vec3f& corner) const {
  const std::int32_t place = mFar.place(e.block);
  return place >= 0 && mFar.edges(place, e.axis()).test(e.x(), e.y(), e.z()) &&
         distance(mTests.rings().low(e), corner) <= mReach[place];
}

template <typename Visit>
bool NearFaces::forEachIn(std::int32_t block, const Vec3d& low, const Vec3d& high, Visit& visit) const {
  static const CellMask kNoEdges;
  const std::int32_t farPlace = mFar.place(block);
  const Coord& coord = mTests.rings().blockCoord(block);
  const Window near(low, high, kCellReach, coord), far(low, high, farPlace < 0 ? kCellReach : mReach[farPlace], coord);
  const BlockTopology& topology = mTests.rings().block(block);
  for (int axis = 0; axis < 3; ++axis) {
    const CellMask& farEdges = farPlace < 0 ? kNoEdges : mFar.edges(farPlace, axis);
    for (int x = far.beginX(); x < far.endX(); ++x) {
      const std::uint64_t edges = topology.edges[axis].word[x];
      std::uint64_t wanted = (edges & near.word(x)) | (farEdges.word[x] & far.word(x));
      for (; wanted != 0; wanted &= wanted - 1) {
        const int bit = std::countr_zero(wanted);
        const std::uint64_t before = bitCount(edges & ((std::uint64_t{1} << bit) - 1));
        if (!visit(edgeAt(block, axis, x, bit),
                   topology.firstQuad + topology.quadsBefore[kBlockSize * axis + x] + before))
          return false;
      }
    }
  }
  return true;
}

/// Calls visit(edge, number of its face) for all faces that may reach into a box of lattice space, until it says no.
template <typename Visit>
void NearFaces::forEachNear(const Vec3d& low, const Vec3d& high, Visit&& visit) const {
  Coord from, to;
  for (int i = 0; i < 3; ++i) {
    from[i] = static_cast<std::int32_t>(std::floor(low[i] - mLargestReach)) >> 3;
    to[i] = static_cast<std::int32_t>(std::floor(high[i] + mLargestReach)) >> 3;
  }
  for (Coord b = from; b[0] <= to[0]; ++b[0])
    for (b[1] = from[1]; b[1] <= to[1]; ++b[1])
      for (b[2] = from[2]; b[2] <= to[2]; ++b[2])
        if (const std::int32_t block = mTests.rings().find(b);
            block != BlockIndex::kMissing && !forEachIn(block, low, high, visit))
          return;
}

/// Box, in lattice space, of the face being looked at.
inline std::pair<Vec3d, Vec3d> NearFaces::latticeBox(const EdgeRef& e, const Scratch& own) const {
  if (!mTests.map().affine()) {
    const Coord at = mTests.rings().low(e);
    const Vec3d p{double(at[0]), double(at[1]), double(at[2])}, reach{kFreeReach, kFreeReach, kFreeReach};
    return {p - reach, p + reach};
  }
  constexpr double kHuge = 1e300;
  Vec3d low{kHuge, kHuge, kHuge}, high = low * -1.0;
  for (const TriangleCorners& t : own.corners)
    for (const Vec3f& corner : t) {
      const Vec3d p = latticePosition(corner);
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
    }
  return {low, high};
}

std::vector<NearFaces::Face> NearFaces::facesAbout(const Vec3d& low, const Vec3d& high) const {
  std::vector<Face> faces;
  forEachNear(low, high, [&](const EdgeRef& edge, std::uint64_t face) {
    faces.push_back({edge, face});
    return true;
  });
  return faces;
}

inline void NearFaces::search(const EdgeRef& e, Scratch& own, const EdgeSet* foundFrom,
                              std::vector<Offence>& out) const {
  own.corners.clear();
  own.planes.clear();
  for (const Triangle& t : own.own) {
    own.corners.push_back(mTests.corners(t));
    own.planes.emplace_back(t, own.corners.back());
  }
  Box box(own.corners[0]);
  for (std::size_t i = 0; i < own.own.size(); ++i) {
    if (!mTests.facesForward(e, own.own[i], own.corners[i])) return out.push_back({e, e, own.own[i], own.own[i]});
    for (std::size_t j = 0; j < i; ++j)
      if (trianglesIntersect(own.corners[i], own.own[i], own.corners[j], own.own[j]))
        out.push_back({e, e, own.own[j], own.own[i]});
    for (const Vec3f& p : own.corners[i]) box.add(float4(p));
  }
  const auto isFoundFrom = [&](const EdgeRef& other) {
    return foundFrom != nullptr && other < e && foundFrom->has(other);
  };
  const auto goOn = [&] { return foundFrom != nullptr || out.empty(); };
  if (!goOn()) return;
  const auto [low, high] = latticeBox(e, own);
  forEachNear(low, high, [&](const EdgeRef& other, std::uint64_t face) {
    if (other == e) return true;
    if (const Quad* quad = mTests.quad(face)) {
      const std::array<Vec3f, 4> corners = mTests.corners(*quad);
      if (box.apartFrom(Box(corners)) || isFoundFrom(other)) return true;
      // Nearly always all of the quad is on one side of the face's triangles.
      for (std::size_t i = 0; i < own.own.size(); ++i) {
        if (own.planes[i].clears(*quad, corners)) continue;
        compare(e, own, i, other, {(*quad)[0], (*quad)[1], (*quad)[2]}, {corners[0], corners[1], corners[2]}, out);
        compare(e, own, i, other, {(*quad)[0], (*quad)[2], (*quad)[3]}, {corners[0], corners[2], corners[3]}, out);
      }
    } else if (!isFoundFrom(other)) {
      mTests.triangles(other, face, own.other);
      for (const Triangle& t : own.other)
        for (std::size_t i = 0; i < own.own.size(); ++i) compare(e, own, i, other, t, mTests.corners(t), out);
    }
    return goOn();
  });
}

/// Own triangle i with a triangle of another face.
inline void NearFaces::compare(const EdgeRef& e, const Scratch& own, std::size_t i, const EdgeRef& other,
                               const Triangle& t, const TriangleCorners& corners, std::vector<Offence>& out) const {
  if (own.planes[i].clears(t, corners) || TrianglePlane(t, corners).clears(own.own[i], own.corners[i])) return;
  if (trianglesIntersect(own.corners[i], own.own[i], corners, t)) out.push_back({e, other, own.own[i], t});
}

std::vector<Offence> NearFaces::findOffences(const std::vector<EdgeRef>& active) const {
  tbb::enumerable_thread_specific<Scratch> scratch;
  const EdgeSet all(mTests.rings().blockCount(), active);
  std::vector<Offence> found = gather<Offence>(active.size(), [&](std::size_t i, std::vector<Offence>& out) {
    Scratch& own = scratch.local();
    mTests.triangles(active[i], mTests.rings().face(active[i]), own.own);
    forEachBlock(mLevel, 1, [&](std::size_t) { search(active[i], own, &all, out); });
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
    own.own = {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
    std::vector<Offence> found;
    forEachBlock(mLevel, 1, [&](std::size_t) { search(edges[i], own, nullptr, found); });
    sound[i] = found.empty();
  });
  return sound;
}

}  // namespace pdc::detail
