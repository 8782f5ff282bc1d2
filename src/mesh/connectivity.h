#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// A face at one of its vertices.
struct Corner {
  std::uint32_t face;            ///< Its number, see faces.h.
  std::uint32_t previous, next;  ///< The vertices before and after this one along the face.
  friend auto operator<=>(const Corner&, const Corner&) = default;
};

/// The faces at each vertex of a mesh, in 12 bytes per corner and 8 per vertex. All that is true of a soup can be asked
/// of it: faces may be degenerate, turned against each other, or meet in edges of any number.
class Connectivity {
 public:
  /// Runs in parallel; the result does not depend on the number of threads.
  /// \param mesh its indices are in range. \throws Error for more than 2^32 - 1 faces.
  explicit Connectivity(const Mesh& mesh);

  [[nodiscard]] std::size_t vertices() const { return mFirst.size() - 2; }
  /// The corners at a vertex in ascending order: by face, so that sums over them are those over the faces.
  [[nodiscard]] std::span<const Corner> corners(std::size_t vertex) const {
    return {mCorners.data() + mFirst[vertex], mCorners.data() + mFirst[vertex + 1]};
  }

 private:
  Buffer<std::size_t> mFirst;  ///< Where the corners of each vertex begin; two entries more at the end.
  Buffer<Corner> mCorners;
};

/// A face at an edge.
struct EdgeFace {
  std::uint32_t face;
  bool forward;  ///< Whether the face runs from the edge's first vertex to its second.
  friend auto operator<=>(const EdgeFace&, const EdgeFace&) = default;
};

/// The edges at one vertex, and how its faces hang together. Looks at one vertex after the other, to keep its memory.
class OneRing {
 public:
  void look(const Connectivity& connectivity, std::uint32_t vertex);

  /// Calls visit(neighbour, faces) for each vertex that shares an edge with this one, in ascending order, with the
  /// faces at that edge as a span of EdgeFace: those that run towards this vertex first. A face that names the vertex
  /// twice in a row makes it a neighbour of its own.
  template <typename Visit>
  void forEachEdge(Visit&& visit) const {
    for (std::size_t i = 0; i < mNeighbours.size(); ++i)
      visit(mNeighbours[i], std::span(mFaces).subspan(mFirst[i], mFirst[i + 1] - mFirst[i]));
  }

  /// Whether the faces form one fan, closed or open.
  [[nodiscard]] bool isFan() const;

 private:
  struct Spoke {
    std::uint32_t neighbour;
    bool outgoing;
    std::uint32_t face;
    friend auto operator<=>(const Spoke&, const Spoke&) = default;
  };

  [[nodiscard]] std::size_t node(std::uint32_t neighbour) const;
  [[nodiscard]] bool isConnected() const;

  std::span<const Corner> mCorners;
  std::vector<Spoke> mSpokes;
  std::vector<std::uint32_t> mNeighbours;  ///< Ascending.
  std::vector<std::size_t> mFirst;         ///< Where the faces of each neighbour begin, and one entry more.
  std::vector<EdgeFace> mFaces;
  mutable std::vector<std::size_t> mParent;  ///< Kept for its memory.
};

/// All edges of a mesh by number: those of the lowest vertex first, and of one vertex in the order of the other. Edges
/// that lead from a vertex to itself are left out.
class EdgeTable {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// Runs in parallel; the result does not depend on the number of threads.
  explicit EdgeTable(const Connectivity& connectivity);

  [[nodiscard]] std::size_t size() const { return mVertices.size(); }
  /// The two ends, the lower first.
  [[nodiscard]] const std::array<std::uint32_t, 2>& vertices(std::size_t edge) const { return mVertices[edge]; }
  /// The faces at it in the order of OneRing at the lower end.
  [[nodiscard]] std::span<const EdgeFace> faces(std::size_t edge) const {
    return {mFaces.data() + mFirstFace[edge], mFaces.data() + mFirstFace[edge + 1]};
  }
  [[nodiscard]] bool isBoundary(std::size_t edge) const { return faces(edge).size() == 1; }
  /// The number of the edge between two vertices; kNone if there is none.
  [[nodiscard]] std::size_t find(std::uint32_t a, std::uint32_t b) const;

 private:
  Buffer<std::array<std::uint32_t, 2>> mVertices;
  Buffer<std::size_t> mFirstEdge;  ///< The first edge of each vertex, and one entry more.
  Buffer<std::size_t> mFirstFace;  ///< Where the faces of each edge begin, and one entry more.
  Buffer<EdgeFace> mFaces;
};

}  // namespace pdc::detail
