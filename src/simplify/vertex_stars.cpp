#include "simplify/vertex_stars.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace pdc::detail {
namespace {

/// Faces are counted in so many parts at most: each part has a counter for every vertex.
constexpr int kMostParts = 8;

}  // namespace

void VertexStars::build(std::span<const Triangle> faces, std::size_t vertices) {
  const int parts = std::clamp(tbb::this_task_arena::max_concurrency(), 1, kMostParts);
  mFill.resize(vertices * parts);
  mFirst.resize(vertices + 1);
  // Calls visit(face, corner of it, counter of its part for the vertex there) for all corners.
  const auto forEachCorner = [&](const auto& visit) {
    tbb::parallel_for(0, parts, [&](int part) {
      std::uint32_t* const fill = mFill.data() + vertices * part;
      for (std::size_t f = faces.size() * part / parts, end = faces.size() * (part + 1) / parts; f < end; ++f)
        for (int k = 0; k < 3; ++k) visit(f, k, fill[faces[f][k]]);
    });
  };
  tbb::parallel_for(0, parts, [&](int part) { std::fill_n(mFill.data() + vertices * part, vertices, 0U); });
  forEachCorner([](std::size_t, int, std::uint32_t& count) { ++count; });
  // The faces of a part come after those of earlier parts, so that they ascend whatever the parts are.
  std::uint32_t sum = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    mFirst[v] = sum;
    for (int part = 0; part < parts; ++part) sum += std::exchange(mFill[vertices * part + v], sum);
  }
  mFirst[vertices] = sum;
  mCorners.resize(sum);
  forEachCorner([&](std::size_t f, int k, std::uint32_t& place) {
    const Triangle& t = faces[f];
    mCorners[place++] = {static_cast<std::uint32_t>(f), t[(k + 1) % 3], t[(k + 2) % 3]};
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
