#include "mesh/winding/closed_surface.h"

#include <fmt/format.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "pdc/error.h"
#include "pdc/math/box.h"
#include "pdc/mesh/triangulate_polygons.h"
#include "pdc/mesh/weld_vertices.h"

namespace pdc::detail {
namespace {

/// What rounding to single precision leaves between two copies of a vertex, in longest sides of the box.
constexpr double kCrack = 0x1p-22;

/// An edge from its lower vertex to its upper one, and how often more triangles run along it than against it.
struct DirectedEdge {
  std::uint32_t from, to;
  int times;
};

Mesh finiteTriangles(const Mesh& mesh) {
  Mesh result;
  result.origin = mesh.origin;
  result.positions = mesh.positions;
  result.triangles.reserve(triangleCount(mesh));
  for (std::size_t i = 0; i < triangleCount(mesh); ++i) {
    const Triangle t = triangle(mesh, i);
    const TriangleCorners c = corners(mesh, t);
    if (std::all_of(c.begin(), c.end(), isFinite)) result.triangles.push_back(t);
  }
  return result;
}

double longestSide(const Mesh& mesh) {
  Box box = Box::empty();
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) box.include(vecCast<double>(mesh.positions[v]));
  return box.isEmpty() ? 0 : largestEntry(box.hi - box.lo);
}

/// The edges at which triangles do not cancel, sorted.
std::vector<DirectedEdge> openEdges(const Mesh& mesh) {
  std::vector<DirectedEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      edges.push_back(a < b ? DirectedEdge{a, b, 1} : DirectedEdge{b, a, -1});
    }
  tbb::parallel_sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::pair(a.from, a.to) < std::pair(b.from, b.to);
  });
  std::vector<DirectedEdge> open;
  for (std::size_t i = 0; i < edges.size();) {
    DirectedEdge sum{edges[i].from, edges[i].to, 0};
    for (; i < edges.size() && edges[i].from == sum.from && edges[i].to == sum.to; ++i) sum.times += edges[i].times;
    if (sum.times != 0) open.push_back(sum);
  }
  return open;
}

/// Edges that run from one vertex to the next and back to the first.
using Loop = std::vector<std::uint32_t>;

/// Takes edges apart into loops that pass each vertex once. As many edges leave a vertex as come to it, because those
/// of each triangle do.
class LoopWalk {
 public:
  explicit LoopWalk(const std::vector<DirectedEdge>& edges) {
    for (const DirectedEdge& e : edges)
      for (int i = 0; i < std::abs(e.times); ++i)
        mNext.push_back(e.times > 0 ? Step{e.from, e.to} : Step{e.to, e.from});
    std::sort(mNext.begin(), mNext.end());
    for (std::size_t i = mNext.size(); i > 0; --i) mFirst[mNext[i - 1].first] = i - 1;
  }

  template <typename Visit>
  void forEachLoop(Visit&& visit) {
    for (const Step& step : mNext) {
      std::uint32_t at = step.first;
      mPath.assign(1, at);
      mPlace[at] = 0;
      while (takeStep(at)) {
        const auto before = mPlace.find(at);
        if (before == mPlace.end()) {
          mPlace[at] = mPath.size();
          mPath.push_back(at);
          continue;
        }
        const std::size_t first = before->second;
        visit(Loop(mPath.begin() + static_cast<std::ptrdiff_t>(first), mPath.end()));
        for (; mPath.size() > first + 1; mPath.pop_back()) mPlace.erase(mPath.back());
      }
      mPlace.clear();
    }
  }

 private:
  using Step = std::pair<std::uint32_t, std::uint32_t>;

  /// Goes along an edge that no loop has yet; false if none leads on.
  bool takeStep(std::uint32_t& at) {
    const auto next = mFirst.find(at);
    if (next == mFirst.end() || next->second == mNext.size() || mNext[next->second].first != at) return false;
    at = mNext[next->second++].second;
    return true;
  }

  std::vector<Step> mNext;                                ///< Sorted.
  std::unordered_map<std::uint32_t, std::size_t> mFirst;  ///< The next step that leaves a vertex.
  Loop mPath;
  std::unordered_map<std::uint32_t, std::size_t> mPlace;  ///< Of vertices on the path.
};

/// The mean of a loop's places, by length; edges without length have to be somewhere, too.
Vec3f middleOf(const Mesh& mesh, const Loop& loop) {
  Vec3d sum{};
  double weight = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3d a = vecCast<double>(mesh.positions[loop[i]]);
    const Vec3d b = vecCast<double>(mesh.positions[loop[(i + 1) % loop.size()]]);
    const double own = length(b - a) + std::numeric_limits<float>::min();
    sum += (a + b) * (0.5 * own);
    weight += own;
  }
  return vecCast<float>(sum * (1 / weight));
}

void addCaps(Mesh& mesh) {
  LoopWalk(openEdges(mesh)).forEachLoop([&](const Loop& loop) {
    const auto apex = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(middleOf(mesh, loop));
    for (std::size_t i = 0; i < loop.size(); ++i)
      mesh.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], apex});
  });
}

}  // namespace

std::vector<std::uint32_t> ClosedSurface::caps() const {
  std::vector<std::uint32_t> caps(surface.triangles.size() - own);
  std::iota(caps.begin(), caps.end(), static_cast<std::uint32_t>(own));
  return caps;
}

ClosedSurface closeSurface(const Mesh& mesh, const Monitor& monitor) {
  checkSizes(mesh, "closeSurface", FaceKinds::kAll);
  checkIndices(mesh);
  ClosedSurface closed;
  if (mesh.polygons.empty()) {
    closed.surface = finiteTriangles(mesh);
  } else {
    Mesh triangulated = mesh;
    triangulatePolygons(triangulated);
    closed.surface = finiteTriangles(triangulated);
  }
  monitor.throwIfStopped();
  Mesh& surface = closed.surface;
  static_cast<void>(weldVertices(surface, kCrack * longestSide(surface), monitor));
  std::erase_if(surface.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  closed.own = surface.triangles.size();
  monitor.throwIfStopped();
  addCaps(surface);
  if (surface.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw Error(fmt::format("the mesh has {} triangles with those that close it, more than 2^32 - 1",
                            surface.triangles.size()));
  return closed;
}

}  // namespace pdc::detail
