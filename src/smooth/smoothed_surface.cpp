#include "smooth/smoothed_surface.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>

#include "mesh/faces.h"
#include "parallel/for_each_in_parallel.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kGrain = 4096;

Buffer<Triangle> usableTriangles(const Mesh& mesh) {
  Buffer<Triangle> faces;
  faces.reserve(triangleCount(mesh));
  for (std::size_t i = 0; i < triangleCount(mesh); ++i) {
    const Triangle t = triangle(mesh, i);
    const bool finite = std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return isFinite(mesh.positions[v]); });
    if (finite && t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) faces.push_back(t);
  }
  if (faces.empty()) throw Error(fmt::format("the mesh has {} faces that could be smoothed; the limit is 1", 0));
  return faces;
}

Connectivity connectivityOf(const Buffer<Triangle>& triangles, std::size_t vertices) {
  Mesh mesh;
  mesh.positions.resize(vertices);  // Only their number counts.
  mesh.triangles = triangles;
  return Connectivity(mesh);
}

/// The triangles at one vertex, sought by the vertices before it.
class Fan {
 public:
  void look(std::span<const Corner> corners) {
    mCorners = corners;
    mByPrevious.clear();
    for (std::uint32_t i = 0; i < corners.size(); ++i) mByPrevious.push_back({corners[i].previous, i});
    std::sort(mByPrevious.begin(), mByPrevious.end());
  }

  /// The corner on the other side of the edge to a corner's next vertex; null if there is none.
  [[nodiscard]] const Corner* across(const Corner& corner) const {
    const auto it = std::lower_bound(mByPrevious.begin(), mByPrevious.end(), Entry{corner.next, 0});
    return it != mByPrevious.end() && it->vertex == corner.next ? &mCorners[it->corner] : nullptr;
  }

  /// Whether the triangles form one fan, closed or open, and all run the same way round.
  [[nodiscard]] bool isOne() {
    mNext.clear();
    for (const Corner& c : mCorners) mNext.push_back(c.next);
    std::sort(mNext.begin(), mNext.end());
    const auto sameVertex = [](const Entry& a, const Entry& b) { return a.vertex == b.vertex; };
    if (std::adjacent_find(mNext.begin(), mNext.end()) != mNext.end()) return false;
    if (std::adjacent_find(mByPrevious.begin(), mByPrevious.end(), sameVertex) != mByPrevious.end()) return false;
    // Each edge has one triangle on each side at most, so that going on from the first one leads through a fan.
    const auto first = std::find_if(mCorners.begin(), mCorners.end(), [&](const Corner& c) {
      return !std::binary_search(mNext.begin(), mNext.end(), c.previous);
    });
    const Corner* const begin = first != mCorners.end() ? &*first : mCorners.data();
    std::size_t count = 1;
    for (const Corner* c = across(*begin); c != nullptr && c != begin; c = across(*c)) ++count;
    return count == mCorners.size();
  }

 private:
  struct Entry {
    std::uint32_t vertex, corner;
    friend auto operator<=>(const Entry&, const Entry&) = default;
  };

  std::span<const Corner> mCorners;
  std::vector<Entry> mByPrevious;
  std::vector<std::uint32_t> mNext;
};

std::size_t placeOf(const Triangle& t, std::uint32_t vertex) {
  return static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
}

}  // namespace

SmoothedSurface::SmoothedSurface(const Mesh& mesh, const Monitor& monitor)
    : mTriangles(usableTriangles(mesh)),
      mConnectivity(connectivityOf(mTriangles, mesh.positions.size())),
      mWallFrom(mesh.positions.size(), kNone) {
  monitor.throwIfStopped();
  mFrame = LocalFrame(mesh, mTriangles);
  mPositions.resize(mesh.positions.size());
  forEachInParallel(mPositions.size(), kGrain,
                    [&](std::uint32_t v) { mPositions[v] = mFrame.local(mesh.positions[v]); });
  connectTriangles(monitor);
  monitor.throwIfStopped();
  addWalls();
}

void SmoothedSurface::connectTriangles(const Monitor& monitor) {
  mNeighbours.assign(mTriangles.size(), {kNone, kNone, kNone});
  std::atomic<std::uint32_t> bad = 0, firstBad = kNone;
  tbb::enumerable_thread_specific<Fan> fans;
  forEachInParallel(vertices(), kGrain, [&](std::uint32_t v) {
    if (corners(v).empty()) return;
    if (v % kGrain == 0) monitor.throwIfStopped();
    Fan& fan = fans.local();
    fan.look(corners(v));
    if (!fan.isOne()) {
      ++bad;
      std::uint32_t lowest = firstBad;
      while (v < lowest && !firstBad.compare_exchange_weak(lowest, v)) {
      }
    }
    for (const Corner& c : corners(v))
      if (const Corner* const other = fan.across(c)) mNeighbours[c.face][placeOf(mTriangles[c.face], v)] = other->face;
  });
  if (bad > 0)
    throw Error(
        fmt::format("the surface is no oriented manifold at {} vertices, the first of which is {}; the limit is 0",
                    bad.load(), firstBad.load()));
}

void SmoothedSurface::addWalls() {
  const std::size_t triangles = mTriangles.size();
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      if (mNeighbours[t][k] != kNone) continue;
      const Wall wall{static_cast<std::uint32_t>(t), mTriangles[t][k], mTriangles[t][(k + 1) % 3]};
      mNeighbours[t][k] = mWallFrom[wall.from] = static_cast<std::uint32_t>(triangles + mWalls.size());
      mWalls.push_back(wall);
    }
  mNeighbours.resize(faces());
  for (std::size_t w = 0; w < mWalls.size(); ++w) {
    const auto number = static_cast<std::uint32_t>(triangles + w);
    // At a vertex of one open fan one wall ends and one begins.
    const std::uint32_t after = mWallFrom[mWalls[w].to];
    mNeighbours[number][0] = mWalls[w].triangle;
    mNeighbours[number][2] = after;
    mNeighbours[after][1] = number;
  }
}

}  // namespace pdc::detail
