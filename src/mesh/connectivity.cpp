#include "mesh/connectivity.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <numeric>

#include "mesh/faces.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kGrain = 4096;

template <typename Visit>
void forEach(std::size_t count, Visit&& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) visit(i);
  });
}

std::size_t takeNext(std::size_t& counter) { return std::atomic_ref(counter).fetch_add(1, std::memory_order_relaxed); }

}  // namespace

Connectivity::Connectivity(const Mesh& mesh) : mFirst(mesh.positions.size() + 2, 0) {
  constexpr std::size_t kMostFaces = std::numeric_limits<std::uint32_t>::max();
  const std::size_t faces = faceCount(mesh);
  if (faces > kMostFaces) throw Error(fmt::format("the mesh has {} faces, more than 2^32 - 1", faces));
  // Counted two places on, so that filling leaves each start where it belongs.
  forEach(faces, [&](std::size_t i) {
    for (const std::uint32_t v : face(mesh, i)) takeNext(mFirst[v + std::size_t{2}]);
  });
  std::partial_sum(mFirst.begin(), mFirst.end(), mFirst.begin());
  mCorners.resize(mFirst.back());
  forEach(faces, [&](std::size_t i) {
    const auto f = face(mesh, i);
    for (std::size_t k = 0; k < f.size(); ++k)
      mCorners[takeNext(mFirst[f[k] + std::size_t{1}])] = {static_cast<std::uint32_t>(i),
                                                           f[(k + f.size() - 1) % f.size()], f[(k + 1) % f.size()]};
  });
  // Threads fill the places of a vertex in any order.
  forEach(vertices(), [&](std::size_t v) { std::sort(mCorners.data() + mFirst[v], mCorners.data() + mFirst[v + 1]); });
}

void OneRing::look(const Connectivity& connectivity, std::uint32_t vertex) {
  mCorners = connectivity.corners(vertex);
  mSpokes.clear();
  for (const Corner& c : mCorners) {
    mSpokes.push_back({c.previous, false, c.face});
    mSpokes.push_back({c.next, true, c.face});
  }
  std::sort(mSpokes.begin(), mSpokes.end());
  mNeighbours.clear();
  mFirst.clear();
  mFaces.clear();
  for (const Spoke& spoke : mSpokes) {
    if (mNeighbours.empty() || mNeighbours.back() != spoke.neighbour) {
      mNeighbours.push_back(spoke.neighbour);
      mFirst.push_back(mFaces.size());
    }
    mFaces.push_back({spoke.face, spoke.outgoing});
  }
  mFirst.push_back(mFaces.size());
}

// The neighbours are the nodes and the corners the arcs of a graph; the faces form one fan exactly if that graph is one
// cycle or one path.
bool OneRing::isFan() const {
  std::size_t ends = 0;
  bool branches = false;
  forEachEdge([&](std::uint32_t, std::span<const EdgeFace> faces) {
    ends += faces.size() == 1;
    branches |= faces.size() > 2;
  });
  // Without branches each part is a cycle (as many arcs as nodes) or a path (one arc less, two ends).
  return !branches && ends <= 2 && isConnected();
}

std::size_t OneRing::node(std::uint32_t neighbour) const {
  return static_cast<std::size_t>(std::lower_bound(mNeighbours.begin(), mNeighbours.end(), neighbour) -
                                  mNeighbours.begin());
}

bool OneRing::isConnected() const {
  mParent.resize(mNeighbours.size());
  std::iota(mParent.begin(), mParent.end(), std::size_t{0});
  const auto root = [&](std::size_t n) {
    while (mParent[n] != n) n = mParent[n] = mParent[mParent[n]];
    return n;
  };
  std::size_t parts = mNeighbours.size();
  for (const Corner& c : mCorners) {
    const std::size_t a = root(node(c.previous)), b = root(node(c.next));
    parts -= a != b;
    mParent[a] = b;
  }
  return parts <= 1;
}

EdgeTable::EdgeTable(const Connectivity& connectivity) : mFirstEdge(connectivity.vertices() + 1, 0) {
  const std::size_t vertices = connectivity.vertices();
  tbb::enumerable_thread_specific<OneRing> rings;
  const auto forEachEdgeUp = [&](std::size_t v, auto&& visit) {
    OneRing& ring = rings.local();
    ring.look(connectivity, static_cast<std::uint32_t>(v));
    ring.forEachEdge([&](std::uint32_t neighbour, std::span<const EdgeFace> faces) {
      if (neighbour > v) visit(neighbour, faces);
    });
  };
  Buffer<std::size_t> firstFace(vertices + 1, 0);
  forEach(vertices, [&](std::size_t v) {
    forEachEdgeUp(v, [&](std::uint32_t, std::span<const EdgeFace> faces) {
      ++mFirstEdge[v + 1];
      firstFace[v + 1] += faces.size();
    });
  });
  std::partial_sum(mFirstEdge.begin(), mFirstEdge.end(), mFirstEdge.begin());
  std::partial_sum(firstFace.begin(), firstFace.end(), firstFace.begin());
  mVertices.resize(mFirstEdge.back());
  mFirstFace.resize(mVertices.size() + 1);
  mFaces.resize(firstFace.back());
  mFirstFace.back() = mFaces.size();
  forEach(vertices, [&](std::size_t v) {
    std::size_t edge = mFirstEdge[v], place = firstFace[v];
    forEachEdgeUp(v, [&](std::uint32_t neighbour, std::span<const EdgeFace> faces) {
      mVertices[edge] = {static_cast<std::uint32_t>(v), neighbour};
      mFirstFace[edge++] = place;
      std::copy(faces.begin(), faces.end(), mFaces.begin() + static_cast<std::ptrdiff_t>(place));
      place += faces.size();
    });
  });
}

std::size_t EdgeTable::find(std::uint32_t a, std::uint32_t b) const {
  const std::array<std::uint32_t, 2> wanted{std::min(a, b), std::max(a, b)};
  if (wanted[1] >= mFirstEdge.size() - 1) return kNone;
  const auto begin = mVertices.begin() + static_cast<std::ptrdiff_t>(mFirstEdge[wanted[0]]);
  const auto end = mVertices.begin() + static_cast<std::ptrdiff_t>(mFirstEdge[wanted[0] + std::size_t{1}]);
  const auto it = std::lower_bound(begin, end, wanted);
  return it != end && *it == wanted ? static_cast<std::size_t>(it - mVertices.begin()) : kNone;
}

}  // namespace pdc::detail
