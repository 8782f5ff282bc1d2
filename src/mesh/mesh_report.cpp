#include "pdc/mesh/mesh_report.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <compare>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "mesh/faces.h"

namespace pdc {
namespace {

using Index = std::uint32_t;
using detail::face;
using detail::faceCount;
using detail::isFinite;

/// Grain of all reductions: sums are split the same way whatever the number of threads.
constexpr std::size_t kGrain = 4096;

/// One corner of one face: the vertex and its two neighbours along the face. Sorted by vertex, the corners of a vertex
/// tell all about its fan and its edges, in 12 bytes per corner and without a map.
struct Corner {
  Index vertex, previous, next;
  friend auto operator<=>(const Corner&, const Corner&) = default;
};

template <typename Value, typename Visit>
Value sumOver(std::size_t count, Visit&& visit) {
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, count, kGrain), Value{},
      [&](const tbb::blocked_range<std::size_t>& range, Value sum) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) visit(i, sum);
        return sum;
      },
      [](Value a, const Value& b) { return a += b; });
}

Buffer<Corner> sortedCorners(const Mesh& mesh) {
  const std::size_t quadCorners = 4 * mesh.quads.size();
  Buffer<Corner> corners(quadCorners + 3 * mesh.triangles.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, faceCount(mesh), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const auto f = face(mesh, i);
      Corner* out = corners.data() + (f.size() == 4 ? 4 * i : quadCorners + 3 * (i - mesh.quads.size()));
      for (std::size_t k = 0; k < f.size(); ++k)
        out[k] = {f[k], f[(k + f.size() - 1) % f.size()], f[(k + 1) % f.size()]};
    }
  });
  tbb::parallel_sort(corners.begin(), corners.end());
  return corners;
}

struct FanCounts {
  std::size_t usedVertices = 0, edges = 0, boundary = 0, nonManifold = 0, misoriented = 0, nonManifoldVertices = 0;

  FanCounts& operator+=(const FanCounts& o) {
    usedVertices += o.usedVertices;
    edges += o.edges;
    boundary += o.boundary;
    nonManifold += o.nonManifold;
    misoriented += o.misoriented;
    nonManifoldVertices += o.nonManifoldVertices;
    return *this;
  }
};

/// The faces about one vertex. Its neighbours are the nodes and its corners the arcs of a graph; the faces form one fan
/// exactly if that graph is one cycle or one path.
class Fan {
 public:
  explicit Fan(std::span<const Corner> corners) : mCorners(corners) {
    mSpokes.clear();
    for (const Corner& c : corners) {
      mSpokes.push_back({c.previous, false});
      mSpokes.push_back({c.next, true});
    }
    std::sort(mSpokes.begin(), mSpokes.end());
  }

  /// Counts each edge at its lower end only. A face that names a vertex twice in a row has no edge there.
  void countEdges(Index vertex, FanCounts& counts) const {
    forEachSpoke([&](Index neighbour, std::size_t incoming, std::size_t outgoing) {
      if (neighbour <= vertex) return;
      const std::size_t faces = incoming + outgoing;
      ++counts.edges;
      counts.boundary += faces == 1;
      counts.nonManifold += faces > 2;
      counts.misoriented += faces == 2 && incoming != outgoing;
    });
  }

  [[nodiscard]] bool isSingle() const {
    std::size_t nodes = 0, ends = 0;
    bool branches = false;
    forEachSpoke([&](Index, std::size_t incoming, std::size_t outgoing) {
      ++nodes;
      ends += incoming + outgoing == 1;
      branches |= incoming + outgoing > 2;
    });
    // Without branches each part is a cycle (as many arcs as nodes) or a path (one arc less, two ends).
    return !branches && ends <= 2 && reachableFromFirst() == nodes;
  }

 private:
  struct Spoke {
    Index neighbour;
    bool outgoing;
    friend auto operator<=>(const Spoke&, const Spoke&) = default;
  };

  template <typename Visit>
  void forEachSpoke(Visit&& visit) const {
    for (std::size_t i = 0; i < mSpokes.size();) {
      const Index neighbour = mSpokes[i].neighbour;
      std::size_t incoming = 0, outgoing = 0;
      for (; i < mSpokes.size() && mSpokes[i].neighbour == neighbour; ++i)
        ++(mSpokes[i].outgoing ? outgoing : incoming);
      visit(neighbour, incoming, outgoing);
    }
  }

  [[nodiscard]] std::size_t node(Index neighbour) const {
    return static_cast<std::size_t>(std::lower_bound(mNodes.begin(), mNodes.end(), neighbour) - mNodes.begin());
  }

  [[nodiscard]] std::size_t root(std::size_t n) const {
    while (mParent[n] != n) n = mParent[n] = mParent[mParent[n]];
    return n;
  }

  [[nodiscard]] std::size_t reachableFromFirst() const {
    mNodes.clear();
    forEachSpoke([&](Index neighbour, std::size_t, std::size_t) { mNodes.push_back(neighbour); });
    mParent.resize(mNodes.size());
    for (std::size_t n = 0; n < mParent.size(); ++n) mParent[n] = n;
    for (const Corner& c : mCorners) mParent[root(node(c.previous))] = root(node(c.next));
    std::size_t reachable = 0;
    for (std::size_t n = 0; n < mParent.size(); ++n) reachable += root(n) == root(0);
    return reachable;
  }

  std::span<const Corner> mCorners;
  // One fan is looked at after the other: memory is kept from fan to fan.
  inline static thread_local std::vector<Spoke> mSpokes;
  inline static thread_local std::vector<Index> mNodes;
  inline static thread_local std::vector<std::size_t> mParent;
};

FanCounts countFans(const Buffer<Corner>& corners) {
  return sumOver<FanCounts>(corners.size(), [&](std::size_t i, FanCounts& counts) {
    const Index vertex = corners[i].vertex;
    if (i > 0 && corners[i - 1].vertex == vertex) return;
    std::size_t end = i + 1;
    while (end < corners.size() && corners[end].vertex == vertex) ++end;
    const Fan fan({corners.data() + i, end - i});
    ++counts.usedVertices;
    fan.countEdges(vertex, counts);
    counts.nonManifoldVertices += !fan.isSingle();
  });
}

/// Faces that name a vertex twice, and faces whose set of vertices was seen before.
void countFaces(const Mesh& mesh, MeshReport& report) {
  // The vertices in increasing order, each once, the last one repeated to fill four places: equal for equal sets.
  Buffer<Quad> sets(faceCount(mesh));
  report.degenerateFaces = sumOver<std::size_t>(sets.size(), [&](std::size_t i, std::size_t& degenerate) {
    const auto f = face(mesh, i);
    Quad& set = sets[i];
    std::copy(f.begin(), f.end(), set.begin());
    const auto end = set.begin() + static_cast<std::ptrdiff_t>(f.size());
    std::sort(set.begin(), end);
    const auto last = std::unique(set.begin(), end);
    degenerate += last != end;
    std::fill(last, set.end(), *(last - 1));
  });
  tbb::parallel_sort(sets.begin(), sets.end());
  report.duplicateFaces = sumOver<std::size_t>(
      sets.size(), [&](std::size_t i, std::size_t& duplicates) { duplicates += i > 0 && sets[i] == sets[i - 1]; });
}

/// Union-find over vertices. Threads link roots by compare-and-swap, always the higher under the lower, so which trees
/// grow depends on timing but the sets, and with them the count, do not.
class VertexSets {
 public:
  explicit VertexSets(std::size_t vertices) : mParent(vertices) {
    tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) { mParent[v] = static_cast<Index>(v); });
  }

  void unite(Index a, Index b) {
    for (;;) {
      a = root(a);
      b = root(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      Index expected = a;
      if (std::atomic_ref(mParent[a]).compare_exchange_strong(expected, b)) return;
    }
  }

  [[nodiscard]] bool isRoot(Index v) const { return mParent[v] == v; }

 private:
  Index root(Index v) {
    for (;;) {
      Index parent = std::atomic_ref(mParent[v]).load();
      if (parent == v) return v;
      const Index grandparent = std::atomic_ref(mParent[parent]).load();
      std::atomic_ref(mParent[v]).compare_exchange_strong(parent, grandparent);
      v = grandparent;
    }
  }

  Buffer<Index> mParent;
};

std::size_t countComponents(const Mesh& mesh, const Buffer<Corner>& corners) {
  VertexSets sets(mesh.positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, faceCount(mesh), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      for (const Index v : face(mesh, i)) sets.unite(face(mesh, i)[0], v);
  });
  return sumOver<std::size_t>(corners.size(), [&](std::size_t i, std::size_t& components) {
    const bool first = i == 0 || corners[i - 1].vertex != corners[i].vertex;
    components += first && sets.isRoot(corners[i].vertex);
  });
}

struct Bounds {
  Vec3d lo{kMax, kMax, kMax}, hi{-kMax, -kMax, -kMax};
  static constexpr double kMax = std::numeric_limits<double>::max();

  Bounds& operator+=(const Bounds& o) {
    lo = {std::min(lo.x, o.lo.x), std::min(lo.y, o.lo.y), std::min(lo.z, o.lo.z)};
    hi = {std::max(hi.x, o.hi.x), std::max(hi.y, o.hi.y), std::max(hi.z, o.hi.z)};
    return *this;
  }
  [[nodiscard]] Box box() const { return lo.x <= hi.x ? Box{lo, hi} : Box{{0, 0, 0}, {0, 0, 0}}; }
};

Box boundsOf(const Mesh& mesh, const Buffer<Corner>& corners) {
  const Bounds bounds = sumOver<Bounds>(corners.size(), [&](std::size_t i, Bounds& sum) {
    if (i > 0 && corners[i - 1].vertex == corners[i].vertex) return;
    const Vec3f& p = mesh.positions[corners[i].vertex];
    if (isFinite(p)) sum += {vecCast<double>(p), vecCast<double>(p)};
  });
  return bounds.box();
}

struct Measures {
  double area = 0, volume = 0;
  Measures& operator+=(const Measures& o) {
    area += o.area;
    volume += o.volume;
    return *this;
  }
};

/// Volume is summed relative to `center`, which keeps the terms of a small mesh far from the origin small.
Measures measure(const Mesh& mesh, const Vec3d& center) {
  return sumOver<Measures>(faceCount(mesh), [&](std::size_t i, Measures& sum) {
    const auto f = face(mesh, i);
    for (const Index v : f)
      if (!isFinite(mesh.positions[v])) return;
    const auto at = [&](std::size_t k) { return vecCast<double>(mesh.positions[f[k]]) - center; };
    for (std::size_t k = 2; k < f.size(); ++k) {
      const Vec3d a = at(0), b = at(k - 1), c = at(k);
      sum.area += 0.5 * length(cross(b - a, c - a));
      sum.volume += dot(a, cross(b, c)) / 6.0;
    }
  });
}

}  // namespace

MeshReport analyze(const Mesh& mesh, const Monitor& monitor) {
  detail::checkIndices(mesh);
  MeshReport report;
  report.vertices = mesh.positions.size();
  report.quads = mesh.quads.size();
  report.triangles = mesh.triangles.size();
  report.nonFiniteVertices = sumOver<std::size_t>(
      mesh.positions.size(), [&](std::size_t i, std::size_t& count) { count += !isFinite(mesh.positions[i]); });
  monitor.throwIfStopped();
  countFaces(mesh, report);

  monitor.throwIfStopped();
  const Buffer<Corner> corners = sortedCorners(mesh);
  monitor.throwIfStopped();
  const FanCounts fans = countFans(corners);
  report.edges = fans.edges;
  report.boundaryEdges = fans.boundary;
  report.nonManifoldEdges = fans.nonManifold;
  report.misorientedEdges = fans.misoriented;
  report.nonManifoldVertices = fans.nonManifoldVertices;
  report.unusedVertices = report.vertices - fans.usedVertices;
  report.eulerNumber = static_cast<long long>(fans.usedVertices) - static_cast<long long>(fans.edges) +
                       static_cast<long long>(faceCount(mesh));
  monitor.throwIfStopped();
  report.components = countComponents(mesh, corners);
  report.bounds = boundsOf(mesh, corners);
  const Measures measures = measure(mesh, report.bounds.center());
  report.area = measures.area;
  report.volume = measures.volume;
  return report;
}

}  // namespace pdc
