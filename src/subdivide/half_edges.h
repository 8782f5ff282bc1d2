#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

inline constexpr std::uint32_t kNoHalfEdge = std::numeric_limits<std::uint32_t>::max();

/// The edges of an oriented manifold, one directed half for each of their faces: half-edge k of a face leads from its
/// corner k to the next. Numbers of what refinement makes follow from those before it, so that no table is searched
/// (Dupuy & Vanhoey 2021).
struct HalfEdges {
  std::size_t vertices = 0, edges = 0, faces = 0;
  int sides = 0;                   ///< How many corners every face has: 3, 4, or 0 where they differ.
  Buffer<std::uint32_t> origin;    ///< By half-edge: the vertex that it leads from.
  Buffer<std::uint32_t> twin;      ///< By half-edge: the other one of its edge; kNoHalfEdge at a boundary.
  Buffer<std::uint32_t> edge;      ///< By half-edge.
  Buffer<std::uint32_t> outgoing;  ///< By vertex: one that leads from it; at a boundary the one without a twin.
  Buffer<std::uint32_t> half;      ///< By edge: its half-edge of the lower number.
  Buffer<std::uint8_t> sharp;      ///< By edge: 1 for boundaries and creases.
  Buffer<std::uint32_t> first;     ///< By face and one more, where faces differ: its first half-edge.
  Buffer<std::uint32_t> faceOf;    ///< By half-edge, where faces differ.

  [[nodiscard]] std::size_t size() const { return origin.size(); }
  [[nodiscard]] std::uint32_t face(std::uint32_t h) const {
    return sides == 3 ? h / 3 : sides == 4 ? h / 4 : faceOf[h];
  }
  [[nodiscard]] std::uint32_t next(std::uint32_t h) const {
    if (sides == 3) return h % 3 == 2 ? h - 2 : h + 1;
    if (sides == 4) return (h & ~3U) | ((h + 1) & 3U);
    return h + 1 == first[faceOf[h] + 1] ? first[faceOf[h]] : h + 1;
  }
  [[nodiscard]] std::uint32_t previous(std::uint32_t h) const {
    if (sides == 3) return h % 3 == 0 ? h + 2 : h - 1;
    if (sides == 4) return (h & ~3U) | ((h + 3) & 3U);
    return h == first[faceOf[h]] ? first[faceOf[h] + 1] - 1 : h - 1;
  }
  [[nodiscard]] std::uint32_t target(std::uint32_t h) const { return origin[next(h)]; }

  /// Calls visit(neighbour, edge, h) for each edge at a vertex, counter-clockwise; h leads from the vertex to the
  /// neighbour, and its face is the one between this edge and the next. At a boundary the last edge has none.
  template <typename Visit>
  void forEachSpoke(std::uint32_t vertex, Visit&& visit) const {
    const std::uint32_t begin = outgoing[vertex];
    std::uint32_t h = begin;
    do {
      visit(target(h), edge[h], h);
      const std::uint32_t back = previous(h);
      if (twin[back] == kNoHalfEdge) {
        visit(origin[back], edge[back], kNoHalfEdge);
        return;
      }
      h = twin[back];
    } while (h != begin);
  }
};

/// Makes the half-edges of a mesh whose vertices all have faces. \throws Error for a mesh without faces, a face that
/// names a vertex twice, an edge of more than two faces or of two that run the same way, and a vertex whose faces form
/// several fans. \param creaseAngle in degrees; edges whose faces turn by more are sharp; 180 for none.
[[nodiscard]] HalfEdges makeHalfEdges(const Mesh& mesh, double creaseAngle);

/// What there is after so many steps of refinement, in doubles because it may exceed any integer.
struct RefinedCounts {
  double vertices, edges, faces, halfEdges;
};
[[nodiscard]] RefinedCounts countRefined(const HalfEdges& mesh, bool triangles, int levels);

/// Triangles into four. Corner k of triangle f is a corner of triangle 4f + k, and 4f + 3 lies amid them. The vertex of
/// edge e is number vertices + e.
[[nodiscard]] HalfEdges refineTriangles(const HalfEdges& mesh);
/// Faces into a quad for each corner: quad h begins where half-edge h does. The vertex of edge e is number
/// vertices + e, that of face f is vertices + edges + f.
[[nodiscard]] HalfEdges refinePolygons(const HalfEdges& mesh);

/// The faces of the next level alone, in the same order.
[[nodiscard]] Buffer<Triangle> refinedTriangles(const HalfEdges& mesh);
[[nodiscard]] Buffer<Quad> refinedQuads(const HalfEdges& mesh);

}  // namespace pdc::detail
