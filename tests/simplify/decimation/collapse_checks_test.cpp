#include "simplify/decimation/collapse_checks.h"

#include <gtest/gtest.h>

#include "simplify/shapes.h"

namespace pdc::detail {
namespace {

/// The checks of a mesh.
struct Checked {
  VertexStars stars;
  std::vector<Vec3d> positions;
  Buffer<FaceArea> areas;
  CollapseChecks checks;

  explicit Checked(const Mesh& mesh, double leastCosine = 0.25) : checks(stars, positions, areas, leastCosine) {
    stars.build(mesh.triangles, mesh.positions.size());
    for (const Vec3f& p : mesh.positions) positions.push_back(vecCast<double>(p));
    for (const Triangle& t : mesh.triangles) areas.push_back({positions[t[0]], positions[t[1]], positions[t[2]]});
  }
};

Mesh meshOf(Buffer<Triangle> triangles, std::size_t vertices) {
  Mesh mesh;
  mesh.triangles = std::move(triangles);
  mesh.positions.resize(vertices);
  for (std::size_t v = 0; v < vertices; ++v) mesh.positions[v] = {static_cast<float>(v), 0, 0};
  return mesh;
}

TEST(CollapseChecks, TetrahedronIsNotFlattened) {
  const Checked tetrahedron(meshOf({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 4));
  EXPECT_FALSE(tetrahedron.checks.keepsTopology(0, 1));
}

TEST(CollapseChecks, ThroatIsNotPinched) {
  // A tube of three vertices around: collapsing one of its edges would close it.
  Buffer<Triangle> tube;
  for (std::uint32_t ring = 0; ring < 4; ++ring)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = 3 * ring + k, b = 3 * ring + (k + 1) % 3;
      tube.push_back({a, b, a + 3});
      tube.push_back({b, b + 3, a + 3});
    }
  const Checked checked(meshOf(tube, 15));
  EXPECT_FALSE(checked.checks.keepsTopology(6, 7)) << "around";
  EXPECT_TRUE(checked.checks.keepsTopology(6, 9)) << "along";
}

TEST(CollapseChecks, StripIsNotPinched) {
  const Checked strip(meshOf({{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}}, 6));
  EXPECT_FALSE(strip.checks.keepsTopology(2, 3)) << "across, both at the boundary";
  EXPECT_TRUE(strip.checks.keepsTopology(1, 3)) << "along the boundary";
  EXPECT_FALSE(Checked(meshOf({{0, 1, 2}}, 3)).checks.keepsTopology(0, 1)) << "the last triangle";
}

TEST(CollapseChecks, FacesDoNotTurnOver) {
  const Checked flat(test::plate(4));
  const std::uint32_t a = 12, b = 13;  // Inside of it.
  ASSERT_TRUE(flat.checks.keepsTopology(a, b));
  const Vec3d middle = (flat.positions[a] + flat.positions[b]) * 0.5;
  EXPECT_TRUE(flat.checks.keepsFaces(a, b, middle));
  EXPECT_FALSE(flat.checks.keepsFaces(a, b, middle + Vec3d{0, 0.6, 0})) << "beyond the ring";
  EXPECT_FALSE(flat.checks.keepsFaces(a, b, flat.positions[a] + Vec3d{-0.25, 0, 0})) << "onto the ring: no area";
  EXPECT_TRUE(flat.checks.keepsFaces(a, b, middle + Vec3d{0, 0, 0.1}));
  EXPECT_FALSE(flat.checks.keepsFaces(a, b, middle + Vec3d{0, 0, 2})) << "too steep";
}

}  // namespace
}  // namespace pdc::detail
