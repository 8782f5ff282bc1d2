#include "simplify/vertex_stars.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace pdc::detail {
namespace {

/// Calls visit(face, corner of it) for all corners at vertices from `begin` on, `size` of them.
template <typename Visit>
void forEachCornerIn(std::span<const Triangle> faces, std::uint32_t begin, std::uint32_t size, const Visit& visit) {
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k)
      if (faces[f][k] - begin < size) visit(f, k);  // Smaller ones wrap around.
}

/// Calls visit(first vertex, number of them) for ranges of vertices, in parallel. Each has to look at all faces, so
/// that more than a few would not pay.
template <typename Visit>
void forEachVertexRange(std::size_t vertices, const Visit& visit) {
  constexpr int kMostRanges = 8;
  const int ranges = std::clamp(tbb::this_task_arena::max_concurrency(), 1, kMostRanges);
  tbb::parallel_for(0, ranges, [&](int r) {
    const std::size_t begin = vertices * r / ranges, end = vertices * (r + 1) / ranges;
    visit(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin));
  });
}

}  // namespace

void VertexStars::build(std::span<const Triangle> faces, std::size_t vertices) {
  mFirst.resize(vertices + 1);
  mFill.assign(vertices, 0);
  forEachVertexRange(vertices, [&](std::uint32_t begin, std::uint32_t size) {
    forEachCornerIn(faces, begin, size, [&](std::size_t f, int k) { ++mFill[faces[f][k]]; });
  });
  std::uint32_t sum = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    mFirst[v] = sum;
    sum += mFill[v];
    mFill[v] = mFirst[v];
  }
  mFirst[vertices] = sum;
  mCorners.resize(sum);
  forEachVertexRange(vertices, [&](std::uint32_t begin, std::uint32_t size) {
    forEachCornerIn(faces, begin, size, [&](std::size_t f, int k) {
      const Triangle& t = faces[f];
      mCorners[mFill[t[k]]++] = {static_cast<std::uint32_t>(f), t[(k + 1) % 3], t[(k + 2) % 3]};
    });
  });
}

bool isManifoldStar(std::span<const StarCorner> star) {
  const StarCorner* begin = nullptr;  // The triangle before which the fan is open.
  for (const StarCorner& c : star) {
    int before = 0, after = 0, same = 0;
    for (const StarCorner& other : star) {
      before += other.previous == c.next;
      after += other.next == c.previous;
      same += other.next == c.next;
    }
    if (before > 1 || after > 1 || same > 1) return false;
    if (before == 0) {
      if (begin != nullptr) return false;
      begin = &c;
    }
  }
  if (star.empty()) return true;
  // From triangle to triangle, the last one of an open fan first: all of them must be met.
  std::size_t met = 0;
  const StarCorner* const first = begin != nullptr ? begin : star.data();
  for (const StarCorner* c = first; c != nullptr && met < star.size(); ++met) {
    const std::uint32_t edge = c->previous;
    c = nullptr;
    for (const StarCorner& other : star)
      if (other.next == edge) c = &other;
    if (c == first) {
      ++met;
      break;
    }
  }
  return met == star.size();
}

}  // namespace pdc::detail
