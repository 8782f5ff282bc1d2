#include "simplify/pair_contraction/vertex_pairs.h"

#include <utility>

namespace pdc::detail {

void VertexPairs::add(std::uint32_t a, std::uint32_t b, bool close) {
  const auto p = static_cast<std::uint32_t>(mPairs.size());
  const std::uint32_t nextA = std::exchange(mFirst[a], p), nextB = std::exchange(mFirst[b], p);
  mPairs.push_back({a, b, {nextA, nextB}, close, false, false});
}

void VertexPairs::merge(std::uint32_t a, std::uint32_t b, VertexMarks& marks) {
  marks.clear();
  forEach(a, [&](std::uint32_t p, std::uint32_t other) {
    if (other == b)
      remove(p);
    else
      marks.set(other, p);
  });
  forEach(b, [&](std::uint32_t p, std::uint32_t other) {
    if (!marks.has(other)) return;
    Pair& kept = mPairs[marks[other]];
    kept.close = kept.close || mPairs[p].close;
    remove(p);
  });
  // The pairs that are left change their vertex, not their places in the lists.
  std::uint32_t* link = &mFirst[b];
  while (*link != kNone) {
    Pair& pair = mPairs[*link];
    const int end = pair.a == b ? 0 : 1;
    (end == 0 ? pair.a : pair.b) = a;
    link = &pair.next[end];
  }
  *link = mFirst[a];
  mFirst[a] = std::exchange(mFirst[b], kNone);
}

}  // namespace pdc::detail
