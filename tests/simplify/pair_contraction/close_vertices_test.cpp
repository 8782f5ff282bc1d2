#include "simplify/pair_contraction/close_vertices.h"

#include <gtest/gtest.h>

#include <random>

namespace pdc::detail {
namespace {

TEST(CloseVertices, AreThoseThatAllDistancesSay) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> place(-2, 2);
  std::vector<Vec3d> positions(400);
  for (Vec3d& p : positions) p = {place(engine), place(engine), place(engine)};
  for (std::size_t v = 0; v < 50; ++v) positions[v + 50] = positions[v];
  std::vector<std::uint8_t> used(positions.size(), 1);
  for (std::size_t v = 0; v < used.size(); v += 7) used[v] = 0;
  for (const double distance : {1e-300, 1e-9, 0.1, 0.7, 3.0, 1e9}) {
    const CloseVertices close(positions, used, distance);
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
      if (used[v] == 0) continue;
      std::vector<std::uint32_t> found, expected;
      close.addAbove(v, found);
      for (std::uint32_t other = v + 1; other < positions.size(); ++other)
        if (used[other] != 0 && length(positions[other] - positions[v]) < distance) expected.push_back(other);
      ASSERT_EQ(found, expected) << v << " at " << distance;
    }
  }
}

TEST(CloseVertices, AreCloserThanTheDistance) {
  const std::vector<Vec3d> positions{{0, 0, 0}, {0.5, 0, 0}, {0, -0.25, 0}};
  std::vector<std::uint32_t> found;
  CloseVertices(positions, {1, 1, 1}, 0.5).addAbove(0, found);
  EXPECT_EQ(found, std::vector<std::uint32_t>{2});
}

}  // namespace
}  // namespace pdc::detail
