#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "extract/conflicts/face_tests.h"
#include "extract/conflicts/float4_box.h"
#include "extract/topology/edge_set.h"
#include "pdc/math/box.h"
#include "pdc/monitor.h"

namespace pdc::detail {

/// Finds the faces that may reach into a box: by the cells about their lattice edges, or, for those that may leave
/// these, by how far they reach.
///
/// facesAbout() is inline so that callers compile it for a SimdLevel.
class FaceLocator {
 public:
  /// \param farReaching the edges whose faces may leave the cells about them; sorted. Runs in parallel.
  FaceLocator(const FaceTests& faces, const std::vector<EdgeRef>& farReaching, const Monitor& monitor);

  /// Replaces `out` by the edges whose faces may reach into a box of lattice space.
  void facesAbout(const Box& box, std::vector<EdgeRef>& out) const;

  /// A box of lattice space that holds a box of world space, for affine maps; else one that holds the edge's face.
  [[nodiscard]] Box latticeBox(const EdgeRef& e, const Float4Box& box) const;
  /// For affine maps.
  [[nodiscard]] Box latticeBox(const Float4Box& box) const;
  /// Where a point of world space is in lattice space; for affine maps.
  [[nodiscard]] Vec3d latticePosition(const Vec3f& p) const { return mToLattice * (vecCast<double>(p) - mOrigin); }

  [[nodiscard]] const EdgeSet& farReaching() const { return mFar; }
  /// How far, as distance() has it, corners of the edge's face may go from the low end of the edge so that facesAbout()
  /// still finds the face everywhere; negative if it is not a far-reaching one.
  [[nodiscard]] double farReach(const EdgeRef& e) const { return mFar.has(e) ? mReach[mFar.place(e.block)] : -1; }
  /// From a lattice point to a place in lattice space, along the axis where it is largest.
  [[nodiscard]] static double distance(const Vec3d& from, const Vec3d& place) {
    const Vec3d step = place - from;
    return std::max({std::abs(step.x), std::abs(step.y), std::abs(step.z)});
  }

 private:
  /// The lattice points of a block that are not farther than `reach` from a box, as bits of a CellMask.
  class PointMask {
   public:
    PointMask(const Box& box, double reach, const Coord& block);
    [[nodiscard]] int beginX() const { return mBeginX; }
    [[nodiscard]] int endX() const { return mEndX; }
    [[nodiscard]] std::uint64_t word(int x) const { return x >= mBeginX && x < mEndX ? mWord : 0; }

   private:
    int mBeginX = 0, mEndX = 0;
    std::uint64_t mWord = 0;
  };

  [[nodiscard]] double reachOf(const EdgeRef& e) const;
  void addFacesOf(std::int32_t block, const Box& box, std::vector<EdgeRef>& out) const;

  /// How far, along an axis, a face may reach from the low end of its lattice edge if its vertices are in their cells.
  static constexpr double kCellReach = 1;

  const FaceTests& mFaces;
  const Mat3d mToLattice;
  const Vec3d mOrigin;
  const EdgeSet mFar;  ///< The far-reaching faces.
  /// By block that has some: how far they reach from the low ends of their edges along an axis, in lattice units.
  std::vector<double> mReach;
  double mLargestReach = kCellReach;
};

inline FaceLocator::PointMask::PointMask(const Box& box, double reach, const Coord& block) {
  std::array<int, 3> begin, end;
  for (int i = 0; i < 3; ++i) {
    begin[i] = std::max(static_cast<int>(std::ceil(box.lo[i] - reach)) - kBlockSize * block[i], 0);
    end[i] = std::min(static_cast<int>(std::floor(box.hi[i] + reach)) - kBlockSize * block[i] + 1, kBlockSize);
    if (begin[i] >= end[i]) return;
  }
  mBeginX = begin[0];
  mEndX = end[0];
  const auto upTo = [](int n) { return n == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1; };
  constexpr std::uint64_t kFirstOfEachRow = 0x0101010101010101;
  const std::uint64_t rows = kFirstOfEachRow & (upTo(8 * end[1]) ^ upTo(8 * begin[1]));
  mWord = rows * (upTo(end[2]) ^ upTo(begin[2]));
}

inline void FaceLocator::addFacesOf(std::int32_t block, const Box& box, std::vector<EdgeRef>& out) const {
  const std::int32_t farPlace = mFar.place(block);
  const Coord& coord = mFaces.edgeCells().blockCoord(block);
  const PointMask near(box, kCellReach, coord);
  const BlockTopology& topology = mFaces.edgeCells().block(block);
  const auto add = [&](int axis, int x, std::uint64_t edges) {
    for (; edges != 0; edges &= edges - 1)
      out.push_back({block, static_cast<std::uint16_t>(512 * axis + 64 * x + std::countr_zero(edges))});
  };
  if (farPlace < 0) {
    for (int axis = 0; axis < 3; ++axis)
      for (int x = near.beginX(); x < near.endX(); ++x) add(axis, x, topology.edges[axis].word[x] & near.word(x));
    return;
  }
  const PointMask far(box, mReach[farPlace], coord);
  for (int axis = 0; axis < 3; ++axis)
    for (int x = far.beginX(); x < far.endX(); ++x)
      add(axis, x,
          (topology.edges[axis].word[x] & near.word(x)) | (mFar.edges(farPlace, kAxes[axis]).word[x] & far.word(x)));
}

inline void FaceLocator::facesAbout(const Box& box, std::vector<EdgeRef>& out) const {
  out.clear();
  Coord from, to;
  for (int i = 0; i < 3; ++i) {
    from[i] = static_cast<std::int32_t>(std::floor(box.lo[i] - mLargestReach)) >> 3;
    to[i] = static_cast<std::int32_t>(std::floor(box.hi[i] + mLargestReach)) >> 3;
  }
  for (Coord b = from; b[0] <= to[0]; ++b[0])
    for (b[1] = from[1]; b[1] <= to[1]; ++b[1])
      for (b[2] = from[2]; b[2] <= to[2]; ++b[2])
        if (const std::int32_t block = mFaces.edgeCells().find(b); block != BlockIndex::kMissing)
          addFacesOf(block, box, out);
}

inline Box FaceLocator::latticeBox(const Float4Box& box) const {
  constexpr double kHuge = 1e300;
  Box result{{kHuge, kHuge, kHuge}, {-kHuge, -kHuge, -kHuge}};
  for (int corner = 0; corner < 8; ++corner) {
    Vec3f at;
    for (int i = 0; i < 3; ++i) at[i] = (corner >> i & 1) != 0 ? box.high[i] : box.low[i];
    const Vec3d p = latticePosition(at);
    for (int i = 0; i < 3; ++i) {
      result.lo[i] = std::min(result.lo[i], p[i]);
      result.hi[i] = std::max(result.hi[i], p[i]);
    }
  }
  return result;
}

}  // namespace pdc::detail
