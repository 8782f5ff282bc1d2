#include "pdc/mesh/self_intersections.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <utility>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "mesh/triangle_tree.h"
#include "pdc/error.h"

namespace pdc {
namespace {

using detail::TriangleTree;
using Pair = std::array<std::uint32_t, 2>;
using Pairs = std::vector<Pair>;

constexpr std::size_t kChunk = 4096;        // triangles
constexpr std::size_t kLeavesAtOnce = 256;  // leaves searched between two looks at the count

/// What is to be searched, and what is left out.
struct Candidates {
  Buffer<std::uint32_t> triangles;
  std::size_t degenerate = 0, nonFinite = 0;
};

enum class Kind { kSound, kDegenerate, kNonFinite };

Kind kindOf(const Mesh& mesh, std::size_t i) {
  const detail::TriangleCorners t = detail::corners(mesh, detail::triangle(mesh, i));
  if (!std::all_of(t.begin(), t.end(), detail::isFinite)) return Kind::kNonFinite;
  return detail::isDegenerate(t) ? Kind::kDegenerate : Kind::kSound;
}

Candidates candidatesOf(const Mesh& mesh) {
  const std::size_t count = detail::triangleCount(mesh);
  if (count > std::numeric_limits<std::uint32_t>::max())
    throw Error(fmt::format("the mesh has {} triangles, more than 2^32 - 1", count));
  const std::size_t chunks = (count + kChunk - 1) / kChunk;
  std::vector<std::array<std::size_t, 3>> kinds(chunks);
  const auto forEach = [&](std::size_t chunk, auto&& visit) {
    for (std::size_t i = kChunk * chunk; i < std::min(count, kChunk * (chunk + 1)); ++i) visit(i, kindOf(mesh, i));
  };
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    forEach(chunk, [&](std::size_t, Kind kind) { ++kinds[chunk][static_cast<std::size_t>(kind)]; });
  });

  Candidates result;
  std::vector<std::size_t> first(chunks + 1, 0);
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    first[chunk + 1] = first[chunk] + kinds[chunk][0];
    result.degenerate += kinds[chunk][1];
    result.nonFinite += kinds[chunk][2];
  }
  result.triangles.resize(first.back());
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    std::uint32_t* out = result.triangles.data() + first[chunk];
    forEach(chunk, [&](std::size_t i, Kind kind) {
      if (kind == Kind::kSound) *out++ = static_cast<std::uint32_t>(i);
    });
  });
  return result;
}

/// The triangles of a leaf, gathered.
struct Leaf {
  std::span<const std::uint32_t> numbers;
  std::array<Triangle, TriangleTree::kLeaf> vertices;
  std::array<detail::TriangleCorners, TriangleTree::kLeaf> corners;
  std::array<BoxF, TriangleTree::kLeaf> boxes;

  Leaf(const Mesh& mesh, std::span<const std::uint32_t> triangles) : numbers(triangles) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      vertices[i] = detail::triangle(mesh, numbers[i]);
      corners[i] = detail::corners(mesh, vertices[i]);
      boxes[i] = detail::boxOf(corners[i]);
    }
  }
};

/// Searches runs of leaves. Runs are searched in any order, but only the first maxPairs + 1 pairs in the order of the
/// runs matter: a run needs no more than what those before it leave of them. It goes by what they have found so far,
/// which is never more than what they will, so what is kept in the end does not depend on timing.
class Search {
 public:
  Search(const Mesh& mesh, const TriangleTree& tree, std::size_t maxPairs, const Monitor& monitor)
      : mMesh(mesh),
        mTree(tree),
        mMonitor(monitor),
        mWanted(maxPairs + (maxPairs < std::numeric_limits<std::size_t>::max())),
        mFound((tree.leafCount() + kLeavesAtOnce - 1) / kLeavesAtOnce),
        mCounts(mFound.size()) {}

  /// All pairs, or maxPairs + 1 of them.
  Pairs run() {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mFound.size(), 1), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) searchRun(i);
    });
    Pairs all;
    for (const Pairs& found : mFound) {
      const std::size_t room = std::min(found.size(), mWanted - all.size());
      all.insert(all.end(), found.begin(), found.begin() + static_cast<std::ptrdiff_t>(room));
    }
    return all;
  }

 private:
  void searchRun(std::size_t run) {
    const std::size_t before =
        std::accumulate(mCounts.begin(), mCounts.begin() + static_cast<std::ptrdiff_t>(run), std::size_t{0},
                        [](std::size_t sum, const auto& count) { return sum + count.load(std::memory_order_relaxed); });
    const std::size_t wanted = mWanted - std::min(before, mWanted);
    const std::size_t end = std::min(mTree.leafCount(), kLeavesAtOnce * (run + 1));
    Pairs& found = mFound[run];
    for (std::size_t i = kLeavesAtOnce * run; i < end && found.size() < wanted; ++i) {
      const Leaf leaf(mMesh, mTree.leaf(i));
      mTree.visitNeighbours(i, [&](std::size_t j) {
        mMonitor.throwIfStopped();
        if (j == i) {
          searchLeaf(leaf, found);
        } else {
          searchLeaves(leaf, Leaf(mMesh, mTree.leaf(j)), found);
        }
        return found.size() < wanted;
      });
    }
    mCounts[run].store(found.size(), std::memory_order_relaxed);
    if (!mMonitor.progress) return;
    const std::size_t done = mDone.fetch_add(1, std::memory_order_relaxed) + 1;
    mMonitor.progress("intersecting", static_cast<double>(done) / static_cast<double>(mFound.size()));
  }

  static void searchPair(const Leaf& a, std::size_t i, const Leaf& b, std::size_t j, Pairs& found) {
    if (!a.boxes[i].meets(b.boxes[j])) return;
    if (!detail::trianglesIntersect(a.corners[i], a.vertices[i], b.corners[j], b.vertices[j])) return;
    found.push_back({std::min(a.numbers[i], b.numbers[j]), std::max(a.numbers[i], b.numbers[j])});
  }

  static void searchLeaf(const Leaf& leaf, Pairs& found) {
    for (std::size_t i = 1; i < leaf.numbers.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) searchPair(leaf, i, leaf, j, found);
  }

  static void searchLeaves(const Leaf& a, const Leaf& b, Pairs& found) {
    for (std::size_t i = 0; i < a.numbers.size(); ++i)
      for (std::size_t j = 0; j < b.numbers.size(); ++j) searchPair(a, i, b, j, found);
  }

  const Mesh& mMesh;
  const TriangleTree& mTree;
  const Monitor& mMonitor;
  std::size_t mWanted;
  std::vector<Pairs> mFound;
  std::vector<std::atomic<std::size_t>> mCounts;
  std::atomic<std::size_t> mDone{0};
};

}  // namespace

SelfIntersections selfIntersections(const Mesh& mesh, const SelfIntersectionOptions& options, const Monitor& monitor) {
  detail::checkSizes(mesh, "selfIntersections");
  detail::checkIndices(mesh);
  monitor.throwIfStopped();
  Candidates candidates = candidatesOf(mesh);
  SelfIntersections result;
  result.degenerateTriangles = candidates.degenerate;
  result.nonFiniteTriangles = candidates.nonFinite;
  const TriangleTree tree(mesh, std::move(candidates.triangles));
  monitor.throwIfStopped();
  result.pairs = Search(mesh, tree, options.maxPairs, monitor).run();
  result.complete = result.pairs.size() <= options.maxPairs;
  if (!result.complete) result.pairs.resize(options.maxPairs);
  tbb::parallel_sort(result.pairs.begin(), result.pairs.end());
  return result;
}

}  // namespace pdc
