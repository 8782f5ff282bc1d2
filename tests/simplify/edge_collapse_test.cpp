#include "simplify/edge_collapse.h"

#include <gtest/gtest.h>

#include <random>

#include "simplify/decimation/edge_lanes.h"

namespace pdc::detail {
namespace {

/// Two vertices with random planes.
struct RandomEdge {
  std::vector<Vec3d> positions{2};
  Buffer<VertexQuadric> quadrics;
  std::vector<std::uint8_t> locked{0, 0};
  Vec3d between;

  explicit RandomEdge(unsigned seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vec3d{normal(engine), normal(engine), normal(engine)}; };
    for (Vec3d& p : positions) p = vector();
    for (int v = 0; v < 2; ++v) {
      VertexQuadric q{Quadric<double>::zero(), 6, vector()};
      for (int i = 0; i < 6; ++i) q.q += probabilisticPlaneQuadric(vector() * 0.1, vector(), 0.1);
      quadrics.push_back(q);
    }
    between = vector() * 0.2;
  }
};

TEST(EdgeCollapse, GoesToTheLeastOfBothQuadrics) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    RandomEdge edge(seed);
    for (VertexQuadric& q : edge.quadrics) q.vectorArea = Vec3d{};  // No volume to keep.
    const CollapseRule rule(edge.positions, edge.quadrics, edge.locked);
    const EdgeCollapse c = rule.collapse(0, 1, Vec3d{});
    const auto error = [&](const Vec3d& x) {
      return edge.quadrics[0].q(x - edge.positions[0]) + edge.quadrics[1].q(x - edge.positions[1]);
    };
    EXPECT_NEAR(c.cost, error(c.place), 1e-9 * (1 + c.cost));
    if (c.limited) continue;
    for (const Vec3d& step : {Vec3d{1e-3, 0, 0}, Vec3d{0, -1e-3, 0}, Vec3d{0, 0, 1e-3}})
      EXPECT_GT(error(c.place + step), error(c.place));
  }
}

TEST(EdgeCollapse, LockedEndStays) {
  RandomEdge edge(3);
  edge.locked[1] = 1;
  const EdgeCollapse c = CollapseRule(edge.positions, edge.quadrics, edge.locked).collapse(0, 1, edge.between);
  EXPECT_EQ(c.place, edge.positions[1]);
}

// A roof whose halves are not in one plane: only on the plane through the ends' ridge does it keep its volume.
TEST(EdgeCollapse, IsDrawnToWhereTheVolumeIsKept) {
  RandomEdge edge(4);
  edge.positions = {{-1, 0, 0}, {1, 0, 0}};
  for (VertexQuadric& q : edge.quadrics) {
    q.q = pointQuadric(Vec3d{0, 0, -0.5}) * 1e-3;
    q.vectorArea = Vec3d{0, 0, 3};
  }
  const EdgeCollapse c = CollapseRule(edge.positions, edge.quadrics, edge.locked).collapse(0, 1, {0, 0, 1});
  EXPECT_NEAR(c.place.z, 0, 1e-3);
}

TEST(EdgeLanes, CostWhatEdgesCostAlone) {
  EdgeLanes lanes;
  std::vector<double> expected;
  for (unsigned seed = 0; seed < 16; ++seed) {
    const RandomEdge edge(seed);
    const CollapseRule rule(edge.positions, edge.quadrics, edge.locked);
    lanes.add(rule, 0, 1, edge.between, 100 + seed);
    const EdgeCollapse c = rule.collapse(0, 1, edge.between);
    expected.push_back(c.limited ? -1 : c.cost);
  }
  EXPECT_TRUE(lanes.full());
  EXPECT_EQ(lanes.tag(5), 105u);
  double costs[kLanes];
  EXPECT_EQ(lanes.solve(costs), 16);
  EXPECT_EQ(lanes.size(), 0);
  for (int i = 0; i < kLanes; ++i) EXPECT_EQ(costs[i], expected[i]);
}

}  // namespace
}  // namespace pdc::detail
