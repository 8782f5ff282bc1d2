#include "simplify/pair_contraction/star_checks.h"

#include <gtest/gtest.h>

#include <random>

#include "simplify/decimation/collapse_checks.h"
#include "simplify/shapes.h"

namespace pdc::detail {
namespace {

/// A mesh with some faces gone, some turned and some double.
std::vector<Triangle> damaged(const Mesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Triangle> faces;
  for (Triangle t : mesh.triangles) {
    const auto fate = random() % 12;
    if (fate == 0) continue;
    if (fate == 1) std::swap(t[0], t[1]);
    if (fate == 2) t[0] = static_cast<std::uint32_t>(random() % mesh.positions.size());
    if (t[0] != t[1] && t[0] != t[2]) faces.push_back(t);
  }
  return faces;
}

TEST(StarChecks, SayWhatThoseOfDecimationSay) {
  std::size_t manifold = 0, others = 0, kept = 0, refused = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Mesh mesh = seed % 2 == 0 ? test::torus(4) : test::cube(3);
    const std::vector<Triangle> faces = damaged(mesh, seed);
    std::vector<Vec3d> positions;
    for (const Vec3f& p : mesh.positions) positions.push_back(vecCast<double>(p));
    VertexStars stars;
    stars.build(faces, positions.size());
    ManifoldStars checks(positions.size());
    const Buffer<FaceArea> areas;
    const CollapseChecks reference(stars, positions, areas, 0);
    for (std::uint32_t a = 0; a < positions.size(); ++a) {
      const bool isManifold = checks.isManifold(stars[a]);
      ASSERT_EQ(isManifold, isManifoldStar(stars[a])) << a << " of " << seed;
      ++(isManifold ? manifold : others);
      for (const StarCorner& c : stars[a]) {
        if (!isManifold || !isManifoldStar(stars[c.next])) continue;
        const bool keeps = checks.keepsTopology(stars[a], stars[c.next], a, c.next);
        ASSERT_EQ(keeps, reference.keepsTopology(a, c.next)) << a << ' ' << c.next << " of " << seed;
        ++(keeps ? kept : refused);
      }
    }
  }
  EXPECT_GT(manifold, 100u);
  EXPECT_GT(others, 100u);
  EXPECT_GT(kept, 100u);
  EXPECT_GT(refused, 100u);
}

}  // namespace
}  // namespace pdc::detail
