#pragma once

#include <cstddef>
#include <vector>

namespace pdc::detail {

/// Weights of a vertex and of its ring: the vertices across its edges, counter-clockwise, and, for quads, those
/// opposite it in the faces, each between two edges.
struct RingMask {
  double centre = 0;
  std::vector<double> edge, face{};
};

/// A limit place; its weights sum to 1.
/// \param n neighbours of the vertex, all around it. \param weight what each counts in the scheme; see loopWeight().
[[nodiscard]] RingMask loopLimit(std::size_t n, double weight);
[[nodiscard]] RingMask catmullClarkLimit(std::size_t n);

/// Two derivatives of the limit surface, in an order that makes their cross product look outwards; the weights of each
/// sum to 0. At regular vertices they are those along the first edge and the second.
struct TangentMasks {
  RingMask u, v;
};
[[nodiscard]] TangentMasks loopTangents(std::size_t n);
[[nodiscard]] TangentMasks catmullClarkTangents(std::size_t n);

/// The second derivatives at regular vertices, in the coordinates of the tangents.
struct SecondMasks {
  RingMask uu, uv, vv;
};
[[nodiscard]] SecondMasks loopSecond();
[[nodiscard]] SecondMasks catmullClarkSecond();

/// Tangents of a sector between two sharp edges, at a vertex that has no others: of the curve, from its second half to
/// its first, and across. \param faces of the sector, 1 or more; its edges are one more.
[[nodiscard]] TangentMasks sectorTangents(std::size_t faces, bool triangles);
/// At a vertex that stays because of three sharp edges or more: along the two edges.
[[nodiscard]] TangentMasks cornerTangents(std::size_t faces, bool triangles);

}  // namespace pdc::detail
