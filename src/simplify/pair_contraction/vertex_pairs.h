#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "simplify/pair_contraction/vertex_marks.h"

namespace pdc::detail {

/// Pairs of vertices that may become one, each of which is in the lists of both of its vertices. No two have the same
/// vertices. 20 bytes per pair.
class VertexPairs {
 public:
  explicit VertexPairs(std::size_t vertices) : mFirst(vertices, kNone) {}

  /// \param close whether it is a pair without an edge, too.
  void add(std::uint32_t a, std::uint32_t b, bool close);

  [[nodiscard]] std::size_t size() const { return mPairs.size(); }
  [[nodiscard]] std::uint32_t lower(std::uint32_t pair) const { return std::min(mPairs[pair].a, mPairs[pair].b); }
  [[nodiscard]] std::uint32_t higher(std::uint32_t pair) const { return std::max(mPairs[pair].a, mPairs[pair].b); }
  [[nodiscard]] bool isClose(std::uint32_t pair) const { return mPairs[pair].close; }
  [[nodiscard]] bool isRemoved(std::uint32_t pair) const { return mPairs[pair].removed; }
  /// Whether it is in the queue, which is for the caller to say.
  [[nodiscard]] bool isQueued(std::uint32_t pair) const { return mPairs[pair].queued; }
  void setQueued(std::uint32_t pair, bool queued) { mPairs[pair].queued = queued; }

  void remove(std::uint32_t pair) { mPairs[pair].removed = true; }
  /// Gives a the pairs of b. That of both goes, and of two that have come to have the same vertices one goes.
  /// \param marks are overwritten.
  void merge(std::uint32_t a, std::uint32_t b, VertexMarks& marks);
  /// Calls visit(pair, the other vertex) for all pairs of a vertex. It may remove that pair.
  template <typename Visit>
  void forEach(std::uint32_t vertex, const Visit& visit) {
    for (std::uint32_t* link = &mFirst[vertex]; *link != kNone;) {
      const std::uint32_t p = *link;
      if (!mPairs[p].removed) visit(p, mPairs[p].a == vertex ? mPairs[p].b : mPairs[p].a);
      std::uint32_t& next = mPairs[p].next[mPairs[p].a == vertex ? 0 : 1];
      if (mPairs[p].removed)
        *link = next;
      else
        link = &next;
    }
  }

 private:
  static constexpr auto kNone = static_cast<std::uint32_t>(-1);

  /// Removed ones stay in the lists, with the vertices that they had, until these are next walked.
  struct Pair {
    std::uint32_t a, b;
    std::uint32_t next[2];  ///< In the lists of a and of b.
    bool close, queued, removed;
  };

  std::vector<Pair> mPairs;
  std::vector<std::uint32_t> mFirst;  ///< By vertex.
};

}  // namespace pdc::detail
