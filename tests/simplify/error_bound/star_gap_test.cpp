#include "simplify/error_bound/star_gap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pdc/mesh/distance.h"
#include "simplify/shapes.h"

namespace pdc::detail {
namespace {

struct Star {
  Mesh mesh;
  DecimatedSurface surface;
  VertexStars stars;

  explicit Star(Mesh m) : mesh(std::move(m)) {
    surface.faces = mesh.triangles;
    surface.frame = LocalFrame(mesh, surface.faces);
    for (const Vec3f& p : mesh.positions) surface.positions.push_back(surface.frame.local(p));
    surface.given = mesh.positions;
    stars.build(surface.faces, surface.positions.size());
  }
  [[nodiscard]] double gap(std::uint32_t a, std::uint32_t b, const Vec3f& to) const {
    return starGap(surface, stars, {a, b, {surface.frame.local(to), 0, false}});
  }
};

/// Vertices of plate(4) by their place in fourths.
std::uint32_t at(int x, int y) { return static_cast<std::uint32_t>(5 * y + x); }

TEST(StarGap, IsZeroInAPlane) {
  const Star star(test::plate(4));
  EXPECT_NEAR(star.gap(at(1, 2), at(2, 2), {0.4F, 0.45F, 0}), 0, 1e-7);
  // Outside of the region there would be faces that look down.
  EXPECT_TRUE(std::isinf(star.gap(at(1, 2), at(2, 2), {0.9F, 0.45F, 0})));
}

TEST(StarGap, IsTheHeightOfATip) {
  Mesh mesh = test::plate(4);
  mesh.positions[at(2, 2)].z = 0.25F;
  EXPECT_NEAR(Star(mesh).gap(at(1, 2), at(2, 2), mesh.positions[at(1, 2)]), 0.25, 1e-6);
}

TEST(StarGap, IsFoundWhereEdgesCross) {
  // The edge between the two falls away: what was a roof along x becomes one along the other diagonal of its square,
  // and only where the edges cross do the surfaces differ most.
  Mesh mesh = test::plate(4);
  for (int x = 0; x < 5; ++x) mesh.positions[at(x, 2)].z = 0.1F;
  const Star star(mesh);
  const Vec3f to{0.375F, 0.625F, 0.05F};
  const double gap = star.gap(at(1, 2), at(2, 2), to);
  EXPECT_GT(gap, 0.05);
  EXPECT_LT(gap, 0.1);
}

TEST(StarGap, IsNotKnownAtTheBoundary) {
  const Star star(test::plate(4));
  EXPECT_TRUE(std::isinf(star.gap(at(0, 2), at(1, 2), {0, 0.5F, 0})));
}

TEST(StarGap, BoundsDistancesOfRandomStars) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(-0.08F, 0.08F);
  int known = 0;
  for (int i = 0; i < 200; ++i) {
    Mesh mesh = test::plate(4);
    for (Vec3f& p : mesh.positions) p = p + Vec3f{any(random), any(random), any(random)};
    const Star star(mesh);
    const Vec3f to = Vec3f{0.375F, 0.5F, 0} + Vec3f{any(random), any(random), any(random)};
    const double gap = star.gap(at(1, 2), at(2, 2), to);
    if (std::isinf(gap)) continue;
    ++known;
    Mesh after = mesh;
    after.positions[at(1, 2)] = to;
    after.triangles.clear();
    for (Triangle t : mesh.triangles) {
      for (std::uint32_t& v : t) v = v == at(2, 2) ? at(1, 2) : v;
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) after.triangles.push_back(t);
    }
    Buffer<Vec3f> points;
    for (const Triangle& t : after.triangles)
      for (float u = 0; u <= 1; u += 0.125F)
        for (float v = 0; u + v <= 1; v += 0.125F) {
          const Vec3f &p = after.positions[t[0]], &q = after.positions[t[1]], &r = after.positions[t[2]];
          points.push_back(p + (q - p) * u + (r - p) * v);
        }
    for (const double d : distances(points, mesh)) EXPECT_LE(d, gap + 1e-6) << i;
  }
  EXPECT_GT(known, 100);
}

}  // namespace
}  // namespace pdc::detail
