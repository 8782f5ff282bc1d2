#include "pdc/sample/hermite_block.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace pdc {
namespace {

/// Each point inside with the given probability.
BlockSigns randomSigns(std::mt19937_64& random, double density) {
  std::bernoulli_distribution inside(density);
  BlockSigns signs;
  for (std::uint16_t& row : signs.row)
    for (int z = 0; z < kBlockPoints; ++z) row = static_cast<std::uint16_t>(row | unsigned{inside(random)} << z);
  return signs;
}

struct Edge {
  int axis, x, y, z;
  friend bool operator==(const Edge&, const Edge&) = default;
};

/// Straight from what EdgeIndex promises.
std::vector<Edge> edgesOf(const BlockSigns& signs) {
  std::vector<Edge> edges;
  for (int axis = 0; axis < 3; ++axis)
    for (int x = 0; x < kBlockPoints; ++x)
      for (int y = 0; y < kBlockPoints; ++y)
        for (int z = 0; z < kBlockPoints; ++z) {
          std::array<int, 3> end{x, y, z};
          if (++end[axis] < kBlockPoints && signs.inside(x, y, z) != signs.inside(end[0], end[1], end[2]))
            edges.push_back({axis, x, y, z});
        }
  return edges;
}

TEST(EdgeIndex, NumbersAllEdgesThatChangeSignInOrder) {
  std::mt19937_64 random(3);
  for (const double density : {0.0, 0.01, 0.3, 0.5, 0.9, 1.0})
    for (int i = 0; i < 50; ++i) {
      const BlockSigns signs = randomSigns(random, density);
      const std::vector<Edge> expected = edgesOf(signs);
      const EdgeIndex edges(signs);
      std::vector<Edge> visited;
      edges.forEach([&](int number, int axis, int x, int y, int z) {
        ASSERT_EQ(number, static_cast<int>(visited.size()));
        ASSERT_EQ(edges(kAxes[axis], x, y, z), number);
        ASSERT_GE(number, edges.begin(axis));
        ASSERT_LT(number, edges.begin(axis + 1));
        visited.push_back({axis, x, y, z});
      });
      ASSERT_EQ(visited, expected) << "density " << density;
      ASSERT_EQ(edges.size(), static_cast<int>(expected.size()));
    }
}

}  // namespace
}  // namespace pdc
