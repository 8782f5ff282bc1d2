#include "mesh/intersections/pair_search.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "mesh/faces.h"
#include "mesh/intersections/stand_ins.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kLeavesAtOnce = 256;  // leaves searched between two looks at the count

void append(TrianglePairs& all, const TrianglePairs& found, std::size_t most) {
  const std::size_t room = std::min(found.size(), most - all.size());
  all.insert(all.end(), found.begin(), found.begin() + static_cast<std::ptrdiff_t>(room));
}

}  // namespace

/// The triangles of a leaf, gathered.
struct PairSearch::Leaf {
  std::size_t size;
  std::span<const std::uint32_t> hubs;
  std::array<std::uint32_t, TriangleTree::kLeaf> numbers;
  std::array<Triangle, TriangleTree::kLeaf> vertices;
  std::array<TriangleCorners, TriangleTree::kLeaf> corners;
  std::array<BoxF, TriangleTree::kLeaf> boxes;  ///< The boxes of the shapes.

  Leaf(const PairSearch& search, std::size_t leaf) : hubs(search.mTree.leafHubs(leaf)) {
    const SearchedShapes shapes = search.mShapes;  // A copy, which the loop cannot change.
    const auto inTree = search.mTree.leaf(leaf);
    size = inTree.size();
    for (std::size_t i = 0; i < size; ++i) {
      numbers[i] = shapes.triangles.empty() ? inTree[i] : shapes.triangles[inTree[i]];
      vertices[i] = triangle(search.mMesh, numbers[i]);
      corners[i] = detail::corners(search.mMesh, vertices[i]);
      if (shapes.triangles.empty()) {
        boxes[i] = boxOf(corners[i]);
      } else {
        const BoxF box = boxOf(detail::corners(shapes.mesh, triangle(shapes.mesh, inTree[i])));
        const Vec3f beyond{shapes.margin, shapes.margin, shapes.margin};
        boxes[i] = {box.lo - beyond, box.hi + beyond};
      }
    }
  }
};

PairSearch::PairSearch(const Mesh& mesh, const SearchedShapes& shapes, const TriangleTree& tree, std::size_t wanted,
                       SearchProgress& progress)
    : mMesh(mesh),
      mShapes(shapes),
      mTree(tree),
      mWanted(wanted),
      mProgress(progress),
      mFound((tree.leafCount() + kLeavesAtOnce - 1) / kLeavesAtOnce),
      mCounts(mFound.size()) {}

TrianglePairs PairSearch::run() {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mFound.size(), 1), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) searchRun(i);
  });
  TrianglePairs all;
  for (const TrianglePairs& found : mFound) append(all, found, mWanted);
  return all;
}

void PairSearch::searchRun(std::size_t run) {
  const std::size_t before =
      std::accumulate(mCounts.begin(), mCounts.begin() + static_cast<std::ptrdiff_t>(run), std::size_t{0},
                      [](std::size_t sum, const auto& count) { return sum + count.load(std::memory_order_relaxed); });
  const std::size_t wanted = mWanted - std::min(before, mWanted);
  const std::size_t begin = kLeavesAtOnce * run, end = std::min(mTree.leafCount(), begin + kLeavesAtOnce);
  TrianglePairs& found = mFound[run];
  for (std::size_t i = begin; i < end && found.size() < wanted; ++i) {
    const Leaf leaf(*this, i);
    mTree.visitNeighbours(i, [&](std::size_t j) {
      mProgress.throwIfStopped();
      if (j == i) {
        searchLeaves(leaf, leaf, found);
      } else {
        searchLeaves(leaf, Leaf(*this, j), found);
      }
      return found.size() < wanted;
    });
  }
  mCounts[run].store(found.size(), std::memory_order_relaxed);
  std::size_t triangles = 0;
  for (std::size_t i = begin; i < end; ++i) triangles += mTree.leaf(i).size();
  mProgress.add(triangles);
}

void PairSearch::searchLeaves(const Leaf& a, const Leaf& b, TrianglePairs& found) const {
  for (std::size_t i = 0; i < a.size; ++i)
    for (std::size_t j = 0; j < (&a == &b ? i : b.size); ++j) {
      if (!a.boxes[i].meets(b.boxes[j])) continue;
      if (!a.hubs.empty() && a.hubs[i] != kNoHub && a.hubs[i] == b.hubs[j]) continue;
      if (!trianglesIntersect(a.corners[i], a.vertices[i], b.corners[j], b.vertices[j])) continue;
      found.push_back({std::min(a.numbers[i], b.numbers[j]), std::max(a.numbers[i], b.numbers[j])});
    }
}

namespace {

/// The search among all triangles, then among those of each hub, then, within one, among those of each edge at which
/// many of them meet.
class WholeSearch {
 public:
  WholeSearch(const Mesh& mesh, std::size_t wanted, const Monitor& monitor)
      : mMesh(mesh), mWanted(wanted), mMonitor(monitor), mHubSearch(mesh) {}

  TrianglePairs run(Buffer<std::uint32_t> triangles) {
    const Hubs hubs = mHubSearch.run(triangles, kNoHub,
                                     [&](std::uint32_t t, std::uint32_t hub) { return arcAt(t, hub).has_value(); });
    const auto atHubs = std::count_if(hubs.of.begin(), hubs.of.end(), [](auto hub) { return hub != kNoHub; });
    SearchProgress progress(mMonitor, triangles.size() + static_cast<std::size_t>(atHubs));
    {
      const TriangleTree tree(mMesh, std::move(triangles), hubs.of);
      search({mMesh, {}}, tree, progress);
    }
    for (std::size_t i = 0; i < hubs.vertices.size(); ++i) searchHub(hubs.vertices[i], hubs.triangles[i], progress);
    return std::move(mFound);
  }

 private:
  void search(const SearchedShapes& shapes, const TriangleTree& tree, SearchProgress& progress) {
    mMonitor.throwIfStopped();
    append(mFound, PairSearch(mMesh, shapes, tree, mWanted - mFound.size(), progress).run(), mWanted);
  }

  void searchStandIns(const StandIns& standIns, std::span<const std::uint32_t> hubs, SearchProgress& progress) {
    Buffer<std::uint32_t> all(standIns.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    const TriangleTree tree(standIns.shapes, std::move(all), hubs, kStandInMargin);
    search({standIns.shapes, standIns.triangles, kStandInMargin}, tree, progress);
  }

  void searchHub(std::uint32_t hub, std::span<const std::uint32_t> triangles, SearchProgress& progress) {
    const Hubs edges = mHubSearch.run(
        triangles, hub, [&](std::uint32_t t, std::uint32_t other) { return pageAt(t, hub, other).has_value(); });
    StandIns arcs;
    for (const std::uint32_t t : triangles) arcs.add(t, *arcAt(t, hub));
    searchStandIns(arcs, edges.of, progress);
    const Monitor silent{.progress = {}, .stop = mMonitor.stop};  // They have been counted as arcs.
    SearchProgress counted(silent, triangles.size());
    for (std::size_t i = 0; i < edges.vertices.size(); ++i) {
      StandIns pages;
      for (const std::uint32_t t : edges.triangles[i]) pages.add(t, *pageAt(t, hub, edges.vertices[i]));
      searchStandIns(pages, {}, counted);
    }
  }

  [[nodiscard]] std::optional<TriangleCorners> arcAt(std::uint32_t t, std::uint32_t hub) const {
    const Triangle v = triangle(mMesh, t);
    const int at = v[0] == hub ? 0 : v[1] == hub ? 1 : 2;
    return arcStandIn(place(hub), place(v[(at + 1) % 3]), place(v[(at + 2) % 3]));
  }

  [[nodiscard]] std::optional<TriangleCorners> pageAt(std::uint32_t t, std::uint32_t hub, std::uint32_t other) const {
    const Triangle vertices = triangle(mMesh, t);
    for (const std::uint32_t v : vertices)
      if (v != hub && v != other) return pageStandIn(place(hub), place(other), place(v));
    return std::nullopt;
  }

  [[nodiscard]] const Vec3f& place(std::uint32_t vertex) const { return mMesh.positions[vertex]; }

  const Mesh& mMesh;
  std::size_t mWanted;
  const Monitor& mMonitor;
  HubSearch mHubSearch;
  TrianglePairs mFound;
};

}  // namespace

TrianglePairs intersectingPairs(const Mesh& mesh, Buffer<std::uint32_t> triangles, std::size_t wanted,
                                const Monitor& monitor) {
  return WholeSearch(mesh, wanted, monitor).run(std::move(triangles));
}

}  // namespace pdc::detail
