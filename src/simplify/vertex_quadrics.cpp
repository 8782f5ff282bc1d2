#include "simplify/vertex_quadrics.h"

#include <cmath>

#include "pdc/math/triangle_quadric.h"

namespace pdc::detail {
namespace {

/// The plane that stands on a boundary edge's face: it keeps the boundary's line.
SymMat3<double> boundaryPlane(const Vec3d& edge, const FaceArea& face, const QuadricRule& rule) {
  const Vec3d across = cross(face.vector, edge);
  const double square = dot(across, across), length2 = dot(edge, edge);
  if (!(square > 0)) return SymMat3<double>::zero();
  const double size = rule.ofTriangles() ? length2 * length2 : length2;
  return outer(across) * (face.trust * rule.boundaryWeight * size / square);
}

}  // namespace

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

}  // namespace pdc::detail
