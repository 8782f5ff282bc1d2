#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/polygons/corner_grid.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Makes triangles of polygons, one after the other, and keeps its memory between them. For one thread.
///
/// A polygon is looked at along the axis that is nearest to its normal, where all decisions are exact. If the triangles
/// that fan out from its first corner tile it, those are taken. Otherwise ears are clipped: triangles of three
/// consecutive corners that hold no other corner; those that are flat but for the rounding of coordinates last, since
/// out of the plane such a triangle may meet what joins the polygon there. So the triangles of a polygon that does not
/// meet itself tile it, and only repeated corners and spikes make triangles without area. Others have no right answer,
/// but always as many triangles.
class EarClipper {
 public:
  /// Writes n - 2 triangles for n >= 3 corners, in the sense of the polygon. Takes about n log n steps unless most
  /// triangles are as large as the polygon. Indices must have been checked; positions need not be finite.
  void triangulate(std::span<const std::uint32_t> polygon, const Buffer<Vec3f>& positions, Triangle* out);

 private:
  using Index = std::uint32_t;  ///< Numbers a corner of the polygon.
  /// What surrounds a corner: a flat one lies between its neighbours, a spike goes back the way it came.
  enum class Shape : std::uint8_t { kConvex, kReflex, kFlat, kSpike };
  enum class Test { kClosed, kInside };
  struct Waiting {
    Index ear, next;
  };

  [[nodiscard]] bool project(std::span<const std::uint32_t> polygon, const Buffer<Vec3f>& positions);
  [[nodiscard]] bool isFan() const;
  void start();
  void clipQueued();
  bool clipThin();
  /// \returns whether it was an ear that nothing blocks.
  bool tryEar(Index i, bool evenIfThin);
  void clipUnsafe();
  void clip(Index i);
  void clipRest();
  void put(Index a, Index b, Index c);
  void enqueue(Index i);
  void wake(Index i);

  [[nodiscard]] int turn(Index a, Index b, Index c) const;
  /// Whether a triangle may owe its area to rounding.
  [[nodiscard]] bool isThin(Index a, Index b, Index c) const;
  [[nodiscard]] Shape shapeOf(Index i) const;
  /// A corner that keeps this one from being an ear; kNone if there is none.
  [[nodiscard]] Index blocker(Index ear, Test test) const;
  [[nodiscard]] bool isBlocked(Index ear, Index by, Test test) const;

  std::span<const std::uint32_t> mPolygon;
  Triangle* mOut = nullptr;
  std::vector<PlanePoint> mPoints;
  std::vector<Index> mPrevious, mNext;
  std::vector<Shape> mShapes;
  std::vector<std::uint8_t> mRemoved, mQueued;
  std::size_t mLeft = 0;
  Index mCursor = 0;  ///< A corner that is left.

  double mRounding = 0;  ///< How far coordinates may be from where they should be.
  std::vector<Index> mQueue, mThin;
  std::size_t mThinDone = 0;      ///< How many of mThin have been taken.
  std::vector<Waiting> mWaiting;  ///< Lists of ears, one for each corner that blocks them.
  std::vector<Index> mFirstWaiting;
  std::size_t mUnsafeTests = 0;
  CornerGrid mGrid;  ///< Corners that are not convex at the beginning; clipping makes no others.
  std::vector<Index> mNotConvex;
};

}  // namespace pdc::detail
