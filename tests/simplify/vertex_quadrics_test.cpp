#include "simplify/vertex_quadrics.h"

#include <gtest/gtest.h>

#include "pdc/math/triangle_quadric.h"
#include "simplify/shapes.h"

namespace pdc::detail {
namespace {

/// A mesh, and what its vertices see.
struct Seen {
  Mesh mesh;
  VertexStars stars;
  std::vector<Vec3d> positions;
  Buffer<FaceArea> areas;

  explicit Seen(Mesh given) : mesh(std::move(given)) {
    stars.build(mesh.triangles, mesh.positions.size());
    for (const Vec3f& p : mesh.positions) positions.push_back(vecCast<double>(p));
    for (const Triangle& t : mesh.triangles) areas.push_back({positions[t[0]], positions[t[1]], positions[t[2]]});
  }

  [[nodiscard]] VertexQuadric operator()(std::uint32_t v, const QuadricRule& rule) const {
    return vertexQuadric(v, stars[v], positions, areas, rule);
  }
};

void expectNear(const Quadric<double>& a, const Quadric<double>& b) {
  for (const Vec3d& x : {Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{0.3, -0.2, 0.9}})
    EXPECT_NEAR(a(x), b(x), 1e-12 * (1 + b(x)));
}

TEST(VertexQuadrics, AreSumsOverTheFaces) {
  Mesh ball = test::sphere(4);
  test::addNoise(ball, 0.05);
  const Seen noisy(ball);
  constexpr double kSigma = 0.3, kPosition = 0.2;
  for (std::uint32_t v = 0; v < 10; ++v) {
    Quadric<double> plane = Quadric<double>::zero(), triangle = plane, probabilistic = plane, corners = plane;
    double area = 0;
    for (const StarCorner& c : noisy.stars[v]) {
      const Vec3d p = noisy.positions[v], q = noisy.positions[c.next] - p, r = noisy.positions[c.previous] - p;
      const double size = length(cross(q, r));
      const Vec3d n = cross(q, r) * (1 / size);
      plane += planeQuadric(Vec3d{}, n) * size;
      triangle += triangleQuadric(Vec3d{}, q, r);
      probabilistic += probabilisticPlaneQuadric(Vec3d{}, n, kSigma, kPosition) * size;
      corners += probabilisticTriangleQuadric(Vec3d{}, q, r, kPosition);
      area += size;
    }
    const auto of = [&](QuadricKind kind) { return noisy(v, {kind, kSigma, kPosition, 10}); };
    expectNear(of(QuadricKind::kPlane).q, plane);
    expectNear(of(QuadricKind::kTriangle).q, triangle);
    expectNear(of(QuadricKind::kProbabilisticPlane).q, probabilistic);
    expectNear(of(QuadricKind::kProbabilisticTriangle).q, corners);
    expectNear(of(QuadricKind::kPoint).q, pointQuadric(Vec3d{}) * area);
    EXPECT_NEAR(of(QuadricKind::kPlane).weight, area, 1e-12);
  }
}

TEST(VertexQuadrics, BoundariesStandUp) {
  const Seen flat(test::plate(4));
  const QuadricRule rule{QuadricKind::kPlane, 0, 0, 10};
  // Vertex 2 is in the middle of the lower side, vertex 12 in the middle of the plate.
  const Vec3d out{0, -0.1, 0};
  EXPECT_GT(flat(2, rule).q(out), 100 * flat(12, rule).q(out));
  QuadricRule none = rule;
  none.boundaryWeight = 0;
  EXPECT_LT(flat(2, none).q(out), 0.01 * flat(2, rule).q(out));
}

}  // namespace
}  // namespace pdc::detail
