#include "simplify/vertex_stars.h"

#include <gtest/gtest.h>

#include <vector>

#include "parallel/with_threads.h"
#include "simplify/shapes.h"

namespace pdc::detail {
namespace {

VertexStars starsOf(const std::vector<Triangle>& faces, std::size_t vertices) {
  VertexStars stars;
  stars.build(faces, vertices);
  return stars;
}

TEST(VertexStars, HoldTheCornersByFace) {
  const VertexStars stars = starsOf({{0, 1, 2}, {2, 1, 3}, {5, 2, 0}}, 7);
  ASSERT_EQ(stars.vertices(), 7u);
  ASSERT_EQ(stars[2].size(), 3u);
  const std::vector<std::array<std::uint32_t, 3>> expected{{0, 0, 1}, {1, 1, 3}, {2, 0, 5}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(stars[2][i].face, expected[i][0]);
    EXPECT_EQ(stars[2][i].next, expected[i][1]);
    EXPECT_EQ(stars[2][i].previous, expected[i][2]);
  }
  EXPECT_TRUE(stars[4].empty());
  EXPECT_TRUE(stars[6].empty());
  EXPECT_EQ(stars.cornerCount(), 9u);
}

TEST(VertexStars, AreTheSameForAnyNumberOfThreads) {
  const Mesh ring = test::torus(20);
  VertexStars one, many;
  withThreads(1, [&] { one.build(ring.triangles, ring.positions.size()); });
  withThreads(5, [&] { many.build(ring.triangles, ring.positions.size()); });
  for (std::uint32_t v = 0; v < ring.positions.size(); ++v) {
    ASSERT_EQ(one[v].size(), many[v].size());
    for (std::size_t i = 0; i < one[v].size(); ++i) ASSERT_EQ(one[v][i].face, many[v][i].face);
  }
}

TEST(VertexStars, TellBoundariesAndWhatIsNoManifold) {
  // A fan about vertex 0, closed by the last face.
  std::vector<Triangle> faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  EXPECT_TRUE(atBoundary(starsOf(faces, 9)[0]));
  EXPECT_TRUE(isManifoldStar(starsOf(faces, 9)[0]));
  faces.push_back({0, 4, 1});
  EXPECT_FALSE(atBoundary(starsOf(faces, 9)[0]));
  EXPECT_TRUE(isManifoldStar(starsOf(faces, 9)[0]));

  std::vector<Triangle> twoFans = faces;
  twoFans.push_back({0, 6, 7});
  EXPECT_FALSE(isManifoldStar(starsOf(twoFans, 9)[0]));
  std::vector<Triangle> threeAtAnEdge = faces;
  threeAtAnEdge.push_back({0, 1, 7});
  EXPECT_FALSE(isManifoldStar(starsOf(threeAtAnEdge, 9)[0]));
  EXPECT_FALSE(isManifoldStar(starsOf({{0, 1, 2}, {0, 3, 2}}, 9)[0])) << "the second is turned over";
  // Two closed fans.
  std::vector<Triangle> pinched = faces;
  for (const Triangle& t : std::vector<Triangle>{{0, 5, 6}, {0, 6, 7}, {0, 7, 5}}) pinched.push_back(t);
  EXPECT_FALSE(isManifoldStar(starsOf(pinched, 9)[0]));
}

}  // namespace
}  // namespace pdc::detail
