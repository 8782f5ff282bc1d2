#include "pdc/mesh/mesh_report.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <tuple>

#include "mesh/connectivity.h"
#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "mesh/polygons/ear_clipping.h"

namespace pdc {
namespace {

using Index = std::uint32_t;
using detail::Connectivity;
using detail::EdgeFace;
using detail::face;
using detail::faceCount;
using detail::isFinite;
using detail::OneRing;

/// Grain of all reductions: sums are split the same way whatever the number of threads.
constexpr std::size_t kGrain = 4096;

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

/// Counts each edge at its lower end only. A face that names a vertex twice in a row has no edge there.
void countEdges(const OneRing& ring, std::size_t vertex, FanCounts& counts) {
  ring.forEachEdge([&](Index neighbour, std::span<const EdgeFace> faces) {
    if (neighbour <= vertex) return;
    ++counts.edges;
    counts.boundary += faces.size() == 1;
    counts.nonManifold += faces.size() > 2;
    counts.misoriented += faces.size() == 2 && faces[0].forward == faces[1].forward;
  });
}

FanCounts countFans(const Connectivity& connectivity) {
  tbb::enumerable_thread_specific<OneRing> rings;
  return sumOver<FanCounts>(connectivity.vertices(), [&](std::size_t v, FanCounts& counts) {
    if (connectivity.corners(v).empty()) return;
    OneRing& ring = rings.local();
    ring.look(connectivity, static_cast<Index>(v));
    ++counts.usedVertices;
    countEdges(ring, v, counts);
    counts.nonManifoldVertices += !ring.isFan();
  });
}

using VertexSet = std::span<Index>;

/// Sorts the vertices of a face and drops repeated ones.
VertexSet toSet(VertexSet vertices) {
  std::sort(vertices.begin(), vertices.end());
  return vertices.first(static_cast<std::size_t>(std::unique(vertices.begin(), vertices.end()) - vertices.begin()));
}

/// A set of up to four vertices, the last one repeated to fill four places: equal for equal sets.
Quad filled(const VertexSet& set) {
  Quad quad;
  std::copy(set.begin(), set.end(), quad.begin());
  std::fill(quad.begin() + static_cast<std::ptrdiff_t>(set.size()), quad.end(), set.back());
  return quad;
}

template <typename Set, typename Less, typename Equal>
std::size_t countRepeated(Buffer<Set>& sets, Less&& less, Equal&& equal) {
  tbb::parallel_sort(sets.begin(), sets.end(), less);
  return sumOver<std::size_t>(
      sets.size(), [&](std::size_t i, std::size_t& repeated) { repeated += i > 0 && equal(sets[i], sets[i - 1]); });
}

/// Counts faces that name a vertex twice, and faces whose set of vertices was seen before.
void countFaces(const Mesh& mesh, MeshReport& report) {
  Buffer<Quad> small(mesh.quads.size() + mesh.triangles.size());
  report.degenerateFaces = sumOver<std::size_t>(small.size(), [&](std::size_t i, std::size_t& degenerate) {
    const auto f = face(mesh, i);
    Quad vertices;
    std::copy(f.begin(), f.end(), vertices.begin());
    const VertexSet set = toSet(VertexSet(vertices).first(f.size()));
    degenerate += set.size() < f.size();
    small[i] = filled(set);
  });

  Buffer<Index> corners = mesh.polygons.corners;
  Buffer<VertexSet> large(mesh.polygons.size());
  report.degenerateFaces += sumOver<std::size_t>(large.size(), [&](std::size_t i, std::size_t& degenerate) {
    const std::size_t size = mesh.polygons[i].size();
    large[i] = toSet({corners.data() + mesh.polygons.starts[i], size});
    degenerate += large[i].size() < size;
  });
  const auto isLarge = [](const VertexSet& set) { return set.size() > std::tuple_size_v<Quad>; };
  const auto largeEnd = std::partition(large.begin(), large.end(), isLarge);
  for (auto it = largeEnd; it != large.end(); ++it) small.push_back(filled(*it));
  large.erase(largeEnd, large.end());
  report.duplicateFaces = countRepeated(small, std::less<>(), std::equal_to<>()) +
                          countRepeated(large, std::ranges::lexicographical_compare, std::ranges::equal);
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

std::size_t countComponents(const Mesh& mesh, const Connectivity& connectivity) {
  VertexSets sets(mesh.positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, faceCount(mesh), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      for (const Index v : face(mesh, i)) sets.unite(face(mesh, i)[0], v);
  });
  return sumOver<std::size_t>(connectivity.vertices(), [&](std::size_t v, std::size_t& components) {
    components += !connectivity.corners(v).empty() && sets.isRoot(static_cast<Index>(v));
  });
}

/// Relative to the mesh's origin.
Box boundsOf(const Mesh& mesh, const Connectivity& connectivity) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, connectivity.vertices(), kGrain), Box::empty(),
      [&](const tbb::blocked_range<std::size_t>& range, Box box) {
        for (std::size_t v = range.begin(); v != range.end(); ++v) {
          const Vec3f& p = mesh.positions[v];
          if (!connectivity.corners(v).empty() && isFinite(p)) box.include(vecCast<double>(p));
        }
        return box;
      },
      [](Box a, const Box& b) {
        a.include(b);
        return a;
      });
}

/// The triangles of a polygon, kept with the memory for the next one's.
struct PolygonTriangles {
  detail::EarClipper clipper;
  Buffer<Triangle> triangles;

  const Buffer<Triangle>& of(std::span<const Index> polygon, const Buffer<Vec3f>& positions) {
    triangles.resize(polygon.size() - 2);
    clipper.triangulate(polygon, positions, triangles.data());
    return triangles;
  }
};

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
  tbb::enumerable_thread_specific<PolygonTriangles> polygons;
  return sumOver<Measures>(faceCount(mesh), [&](std::size_t i, Measures& sum) {
    const auto f = face(mesh, i);
    for (const Index v : f)
      if (!isFinite(mesh.positions[v])) return;
    const auto at = [&](Index v) { return vecCast<double>(mesh.positions[v]) - center; };
    const auto add = [&](const Triangle& t) {
      const Vec3d a = at(t[0]), b = at(t[1]), c = at(t[2]);
      sum.area += 0.5 * length(cross(b - a, c - a));
      sum.volume += dot(a, cross(b, c)) / 6.0;
    };
    if (f.size() > std::tuple_size_v<Quad>) {
      for (const Triangle& t : polygons.local().of(f, mesh.positions)) add(t);
    } else {
      for (std::size_t k = 2; k < f.size(); ++k) add({f[0], f[k - 1], f[k]});
    }
  });
}

}  // namespace

MeshReport analyze(const Mesh& mesh, const Monitor& monitor) {
  detail::checkSizes(mesh, "analyze", detail::FaceKinds::kAll);
  detail::checkIndices(mesh);
  MeshReport report;
  report.vertices = mesh.positions.size();
  report.quads = mesh.quads.size();
  report.triangles = mesh.triangles.size();
  report.polygons = mesh.polygons.size();
  report.nonFiniteVertices = sumOver<std::size_t>(
      mesh.positions.size(), [&](std::size_t i, std::size_t& count) { count += !isFinite(mesh.positions[i]); });
  monitor.throwIfStopped();
  countFaces(mesh, report);

  monitor.throwIfStopped();
  const Connectivity connectivity(mesh);
  monitor.throwIfStopped();
  const FanCounts fans = countFans(connectivity);
  report.edges = fans.edges;
  report.boundaryEdges = fans.boundary;
  report.nonManifoldEdges = fans.nonManifold;
  report.misorientedEdges = fans.misoriented;
  report.nonManifoldVertices = fans.nonManifoldVertices;
  report.unusedVertices = report.vertices - fans.usedVertices;
  report.eulerNumber = static_cast<long long>(fans.usedVertices) - static_cast<long long>(fans.edges) +
                       static_cast<long long>(faceCount(mesh));
  monitor.throwIfStopped();
  report.components = countComponents(mesh, connectivity);
  const Box bounds = boundsOf(mesh, connectivity);
  if (!bounds.isEmpty()) report.bounds = {mesh.origin + bounds.lo, mesh.origin + bounds.hi};
  const Measures measures = measure(mesh, bounds.isEmpty() ? Vec3d{} : bounds.center());
  report.area = measures.area;
  report.volume = measures.volume;
  return report;
}

}  // namespace pdc
