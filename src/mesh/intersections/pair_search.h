#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/hubs.h"
#include "mesh/triangle_tree.h"
#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc::detail {

/// Pairs of triangles by number, the smaller first.
using TrianglePairs = std::vector<std::array<std::uint32_t, 2>>;

/// Reports the share of triangles whose neighbours have been searched.
class SearchProgress {
 public:
  SearchProgress(const Monitor& monitor, std::size_t triangles) : mMonitor(monitor), mTriangles(triangles) {}

  void add(std::size_t triangles) {
    if (!mMonitor.progress) return;
    const std::size_t done = mDone.fetch_add(triangles, std::memory_order_relaxed) + triangles;
    mMonitor.progress("intersecting", static_cast<double>(done) / static_cast<double>(mTriangles));
  }
  void throwIfStopped() const { mMonitor.throwIfStopped(); }

 private:
  const Monitor& mMonitor;
  std::size_t mTriangles;
  std::atomic<std::size_t> mDone{0};
};

/// Triangles that are searched, or stand-ins for them.
struct SearchedShapes {
  const Mesh& mesh;                          ///< Its triangles have the numbers in the tree.
  std::span<const std::uint32_t> triangles;  ///< What they stand for; empty: they are the triangles themselves.
  float margin = 0;                          ///< That of the tree.
};

/// Searches runs of leaves of a tree. Runs are searched in any order, but only the first `wanted` pairs in the order of
/// the runs matter: a run needs no more than what those before it leave of them. It goes by what they have found so
/// far, which is never more than what they will, so what is kept in the end does not depend on timing.
class PairSearch {
 public:
  /// \param mesh of the triangles, all of them sound.
  PairSearch(const Mesh& mesh, const SearchedShapes& shapes, const TriangleTree& tree, std::size_t wanted,
             SearchProgress& progress);

  /// The pairs that intersect, or the first `wanted` of them; without those of two triangles at one hub.
  [[nodiscard]] TrianglePairs run();

 private:
  struct Leaf;
  void searchRun(std::size_t run);
  void searchLeaves(const Leaf& a, const Leaf& b, TrianglePairs& found) const;

  const Mesh& mMesh;
  const SearchedShapes& mShapes;
  const TriangleTree& mTree;
  std::size_t mWanted;
  SearchProgress& mProgress;
  std::vector<TrianglePairs> mFound;
  std::vector<std::atomic<std::size_t>> mCounts;
};

/// All pairs of these triangles that intersect, or the first `wanted` of them; see trianglesIntersect. The triangles
/// are sound: finite, and not degenerate. Runs in parallel; what is found depends on the arguments only.
[[nodiscard]] TrianglePairs intersectingPairs(const Mesh& mesh, Buffer<std::uint32_t> triangles, std::size_t wanted,
                                              const Monitor& monitor);

}  // namespace pdc::detail
