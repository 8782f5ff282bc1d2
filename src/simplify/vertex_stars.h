#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// A triangle at one of its vertices.
struct StarCorner {
  std::uint32_t face;
  std::uint32_t next, previous;  ///< The vertices after and before this one along the triangle.
};

/// The triangles at each vertex, by ascending number, in 12 bytes per corner and 8 per vertex, and 4 more for each
/// thread after the first. Made anew for each round of collapses, in memory that is kept.
class VertexStars {
 public:
  /// Runs in parallel; the result does not depend on the number of threads.
  void build(std::span<const Triangle> faces, std::size_t vertices);

  [[nodiscard]] std::size_t vertices() const { return mFirst.size() - 1; }
  [[nodiscard]] std::span<const StarCorner> operator[](std::uint32_t vertex) const {
    return {mCorners.data() + mFirst[vertex], mCorners.data() + mFirst[vertex + 1]};
  }
  /// The number of a vertex's first corner, of all corners.
  [[nodiscard]] std::uint32_t first(std::uint32_t vertex) const { return mFirst[vertex]; }
  [[nodiscard]] const StarCorner& corner(std::uint32_t number) const { return mCorners[number]; }
  [[nodiscard]] std::size_t cornerCount() const { return mCorners.size(); }

 private:
  Buffer<std::uint32_t> mFirst;  ///< One entry more than vertices.
  Buffer<std::uint32_t> mFill;   ///< By part of the faces and vertex, where the next corner goes.
  Buffer<StarCorner> mCorners;
};

/// The triangle on the other side of the edge from the star's vertex to `neighbour`, that is, the one in which the edge
/// runs towards the vertex; null if there is none.
[[nodiscard]] inline const StarCorner* cornerAfter(std::span<const StarCorner> star, std::uint32_t neighbour) {
  for (const StarCorner& c : star)
    if (c.previous == neighbour) return &c;
  return nullptr;
}

/// Whether the surface ends at a vertex with a manifold star: the edge before which its fan begins is another one than
/// that after which it ends.
[[nodiscard]] inline bool atBoundary(std::span<const StarCorner> star) {
  std::uint64_t next = 0, previous = 0;  // All other edges are in both sums.
  for (const StarCorner& c : star) {
    next += c.next;
    previous += c.previous;
  }
  return next != previous;
}

/// Whether a star is one fan, closed or open, whose triangles all run the same way round.
[[nodiscard]] bool isManifoldStar(std::span<const StarCorner> star);

}  // namespace pdc::detail
