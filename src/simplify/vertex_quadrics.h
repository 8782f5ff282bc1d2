#pragma once

#include <cstdint>
#include <vector>

#include "pdc/math/quadric.h"
#include "pdc/math/triangle_quadric.h"
#include "pdc/simplify/decimate.h"
#include "simplify/vertex_stars.h"

namespace pdc::detail {

/// Which quadrics faces have, with their noise: lengths in mean edge lengths.
struct QuadricRule {
  QuadricKind kind;
  double sigmaNormal, sigmaPosition;
  double boundaryWeight;

  /// Whether sums of these quadrics may have no single minimum.
  [[nodiscard]] bool classical() const { return kind == QuadricKind::kPlane || kind == QuadricKind::kTriangle; }
  /// Whether faces count by the squares of their areas.
  [[nodiscard]] bool ofTriangles() const {
    return kind == QuadricKind::kTriangle || kind == QuadricKind::kProbabilisticTriangle;
  }
};

/// What a triangle's neighbours need to know of it.
struct FaceArea {
  Vec3d vector;      ///< The cross product of two edges, twice the vector area.
  double size;       ///< Its length.
  double inverse;    ///< 1 / size, or 0 where there is no area.
  double trust = 1;  ///< What its squared distances are multiplied by: see VertexNoise.

  FaceArea() = default;
  FaceArea(const Vec3d& p, const Vec3d& q, const Vec3d& r)
      : vector(cross(q - p, r - p)), size(length(vector)), inverse(size > 0 ? 1 / size : 0) {}
};

/// What the faces at a vertex sum up to, about the vertex itself: there b and c are small, and so is what rounding does
/// to them.
struct VertexQuadric {
  Quadric<double> q;
  double weight;     ///< The sum of what its faces weigh, which the trace of q.A is near.
  Vec3d vectorArea;  ///< The sum of the faces' vectors.
};

/// Adds the planes through the boundary's edges at the vertex p that stand on their faces.
void addBoundary(VertexQuadric& sum, const Vec3d& p, std::span<const StarCorner> star,
                 const std::vector<Vec3d>& positions, const Buffer<FaceArea>& areas, const QuadricRule& rule);

/// What noise adds to planes through the vertex: see probabilisticPlaneQuadric().
inline void addNoise(VertexQuadric& sum, const QuadricRule& rule) {
  const double n = rule.sigmaNormal * rule.sigmaNormal, p = rule.sigmaPosition * rule.sigmaPosition;
  sum.q.A = sum.q.A.plusDiagonal(n * sum.weight);
  sum.q.c += p * (1 + 3 * n) * sum.weight;
}

/// Sums up the faces at a vertex, and at a boundary the planes through its edges that stand on their faces. It is
/// inline so that callers compile it for a SimdLevel.
inline VertexQuadric vertexQuadric(std::uint32_t vertex, std::span<const StarCorner> star,
                                   const std::vector<Vec3d>& positions, const Buffer<FaceArea>& areas,
                                   const QuadricRule& rule) {
  VertexQuadric sum{Quadric<double>::zero(), 0, Vec3d{}};
  const Vec3d& p = positions[vertex];
  const bool ofTriangles = rule.ofTriangles();
  // All planes go through the vertex, the origin: they have neither b nor c.
  for (const StarCorner& c : star) {
    const FaceArea& face = areas[c.face];
    sum.vectorArea += face.vector;
    sum.q.A += outer(face.vector) * (face.trust * (ofTriangles ? 1 : face.inverse));
    sum.weight += face.trust * (ofTriangles ? face.size * face.size : face.size);
  }
  switch (rule.kind) {
    case QuadricKind::kPlane:
    case QuadricKind::kTriangle:
      break;
    case QuadricKind::kProbabilisticPlane:
      addNoise(sum, rule);
      break;
    case QuadricKind::kProbabilisticTriangle:
      sum.q = Quadric<double>::zero();
      for (const StarCorner& c : star)
        sum.q += probabilisticTriangleQuadric(Vec3d{}, positions[c.next] - p, positions[c.previous] - p,
                                              rule.sigmaPosition) *
                 areas[c.face].trust;
      break;
    case QuadricKind::kPoint:
      sum.q.A = SymMat3<double>::identity() * sum.weight;
      break;
  }
  if (atBoundary(star)) addBoundary(sum, p, star, positions, areas, rule);
  return sum;
}

}  // namespace pdc::detail
