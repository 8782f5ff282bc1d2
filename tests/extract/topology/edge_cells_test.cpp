#include "extract/topology/edge_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

#include "extract/sign_source.h"

namespace pdc::detail {
namespace {

class EdgeCellsTest : public testing::Test {
 protected:
  static SignSource randomSigns() {
    std::mt19937 engine(13);
    std::bernoulli_distribution inside(0.45);
    SignSource source(20);
    for (int i = 0; i < 20 * 20 * 20; ++i) source.set(i / 400, i / 20 % 20, i % 20, inside(engine));
    return source;
  }

  /// Calls visit(edge) for each edge with a quad.
  template <typename Visit>
  void forEachQuad(Visit&& visit) const {
    for (std::size_t b = 0; b < mBlocks.coords.size(); ++b)
      for (const Axis axis : kAxes)
        for (int n = 0; n < kBlockCells; ++n) {
          const BlockCell low{static_cast<std::uint16_t>(n)};
          if (mTopology.blocks[b].edges[axis].test(low.x(), low.y(), low.z()))
            visit(EdgeRef::at(static_cast<std::int32_t>(b), axis, low));
        }
  }
  [[nodiscard]] Coord cellOf(const CellRef& c) const {
    const Coord& b = mBlocks.coords[c.block];
    return {kBlockSize * b[0] + c.x, kBlockSize * b[1] + c.y, kBlockSize * b[2] + c.z};
  }

  const SignSource mSource = randomSigns();
  const SurfaceBlocks mBlocks = mSource.surfaceBlocks({});
  const Topology mTopology = buildTopology(mBlocks, {});
  const EdgeCells mEdgeCells{mBlocks, mTopology};
};

TEST_F(EdgeCellsTest, QuadsAreNumberedThroughInOrder) {
  std::uint64_t next = 0;
  forEachQuad([&](const EdgeRef& e) { ASSERT_EQ(mEdgeCells.face(e), next++); });
  EXPECT_EQ(next, mTopology.quadCount);
  EXPECT_GT(next, 5000u);
}

TEST_F(EdgeCellsTest, CellsAreThoseAboutTheEdgeInOrder) {
  forEachQuad([&](const EdgeRef& e) {
    const Coord low = mEdgeCells.low(e);
    const auto cells = mEdgeCells.cells(e);
    for (int k = 0; k < 4; ++k) {
      Coord expected = low;
      expected[nextAxis(e.axis())] -= kCellsAboutEdge[k][0];
      expected[previousAxis(e.axis())] -= kCellsAboutEdge[k][1];
      ASSERT_EQ(cellOf(cells[k]), expected);
    }
    Coord high = low;
    ++high[e.axis()];
    ASSERT_NE(mSource.inside(low[0], low[1], low[2]), mSource.inside(high[0], high[1], high[2]));
    ASSERT_EQ(mEdgeCells.lowInside(e), mSource.inside(low[0], low[1], low[2]));
  });
}

// From a cell its edges are found, and from the edges the cell.
TEST_F(EdgeCellsTest, EdgesOfACellHaveItAmongTheirCells) {
  std::set<std::tuple<std::int32_t, int, int, int>> seen;
  forEachQuad([&](const EdgeRef& e) {
    const CellRef cell = mEdgeCells.cells(e)[2];
    if (!seen.emplace(cell.block, cell.x, cell.y, cell.z).second) return;
    int edges = 0;
    mEdgeCells.forEachEdge(cell, [&](const EdgeRef& other, int number) {
      ++edges;
      const auto cells = mEdgeCells.cells(other);
      const auto k =
          std::find_if(cells.begin(), cells.end(), [&](const CellRef& c) { return cellOf(c) == cellOf(cell); });
      ASSERT_NE(k, cells.end());
      ASSERT_EQ(edgeInCell(other.axis(), static_cast<int>(k - cells.begin())), number);
    });
    ASSERT_EQ(edges, std::popcount(unsigned{kCellTable[mEdgeCells.code(cell)].edges}));
  });
  EXPECT_GT(seen.size(), 1000u);
}

TEST_F(EdgeCellsTest, VerticesLieInTheirCellsAndCoverTheMesh) {
  std::set<std::uint32_t> used;
  forEachQuad([&](const EdgeRef& e) {
    const Quad quad = mEdgeCells.vertices(e);
    const auto cells = mEdgeCells.cells(e);
    for (int k = 0; k < 4; ++k) {
      const BlockTopology& block = mTopology.blocks[cells[k].block];
      ASSERT_GE(quad[k], block.firstVertex);
      ASSERT_LT(quad[k], block.firstVertex + block.vertexCount);
      used.insert(quad[k]);
    }
  });
  EXPECT_EQ(used.size(), mTopology.vertexCount);
}

}  // namespace
}  // namespace pdc::detail
