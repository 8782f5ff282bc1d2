#pragma once

#include <cstdint>
#include <vector>

#include "pdc/math/quadric.h"
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
  Vec3d vector;    ///< The cross product of two edges, twice the vector area.
  double size;     ///< Its length.
  double inverse;  ///< 1 / size, or 0 where there is no area.

  FaceArea() = default;
  FaceArea(const Vec3d& p, const Vec3d& q, const Vec3d& r);
};

/// What the faces at a vertex sum up to, about the vertex itself: there b and c are small, and so is what rounding does
/// to them.
struct VertexQuadric {
  Quadric<double> q;
  double weight;     ///< The sum of what its faces weigh, which the trace of q.A is near.
  Vec3d vectorArea;  ///< The sum of the faces' vectors.
};

/// Sums up the faces at a vertex, and at a boundary the planes through its edges that stand on their faces.
[[nodiscard]] VertexQuadric vertexQuadric(std::uint32_t vertex, std::span<const StarCorner> star,
                                          const std::vector<Vec3d>& positions, const Buffer<FaceArea>& areas,
                                          const QuadricRule& rule);

}  // namespace pdc::detail
