#include "simplify/decimation/vertex_quadrics.h"

#include <cmath>

#include "pdc/math/triangle_quadric.h"

namespace pdc::detail {
namespace {

/// What noise adds to planes through the vertex: see probabilisticPlaneQuadric().
void addNoise(VertexQuadric& sum, const QuadricRule& rule) {
  const double n = rule.sigmaNormal * rule.sigmaNormal, p = rule.sigmaPosition * rule.sigmaPosition;
  sum.q.A = sum.q.A.plusDiagonal(n * sum.weight);
  sum.q.c += p * (1 + 3 * n) * sum.weight;
}

/// The plane that stands on a boundary edge's face: it keeps the boundary's line.
SymMat3<double> boundaryPlane(const Vec3d& edge, const FaceArea& face, const QuadricRule& rule) {
  const Vec3d across = cross(face.vector, edge);
  const double square = dot(across, across), length2 = dot(edge, edge);
  if (!(square > 0)) return SymMat3<double>::zero();
  return outer(across) * (rule.boundaryWeight * (rule.ofTriangles() ? length2 * length2 : length2) / square);
}

void addBoundary(VertexQuadric& sum, const Vec3d& p, std::span<const StarCorner> star,
                 const std::vector<Vec3d>& positions, const Buffer<FaceArea>& areas, const QuadricRule& rule) {
  for (const StarCorner& c : star) {
    bool begins = true, ends = true;
    for (const StarCorner& other : star) {
      begins = begins && other.previous != c.next;
      ends = ends && other.next != c.previous;
    }
    if (begins) sum.q.A += boundaryPlane(positions[c.next] - p, areas[c.face], rule);
    if (ends) sum.q.A += boundaryPlane(positions[c.previous] - p, areas[c.face], rule);
  }
}

}  // namespace

FaceArea::FaceArea(const Vec3d& p, const Vec3d& q, const Vec3d& r)
    : vector(cross(q - p, r - p)), size(length(vector)), inverse(size > 0 ? 1 / size : 0) {}

VertexQuadric vertexQuadric(std::uint32_t vertex, std::span<const StarCorner> star, const std::vector<Vec3d>& positions,
                            const Buffer<FaceArea>& areas, const QuadricRule& rule) {
  VertexQuadric sum{Quadric<double>::zero(), 0, Vec3d{}};
  const Vec3d& p = positions[vertex];
  const bool ofTriangles = rule.ofTriangles();
  // All planes go through the vertex, the origin: they have neither b nor c.
  for (const StarCorner& c : star) {
    const FaceArea& face = areas[c.face];
    sum.vectorArea += face.vector;
    sum.q.A += outer(face.vector) * (ofTriangles ? 1 : face.inverse);
    sum.weight += ofTriangles ? face.size * face.size : face.size;
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
        sum.q +=
            probabilisticTriangleQuadric(Vec3d{}, positions[c.next] - p, positions[c.previous] - p, rule.sigmaPosition);
      break;
    case QuadricKind::kPoint:
      sum.q.A = SymMat3<double>::identity() * sum.weight;
      break;
  }
  if (atBoundary(star)) addBoundary(sum, p, star, positions, areas, rule);
  return sum;
}

}  // namespace pdc::detail
