#include "sample/meaning/contourable_grids.h"

#include <gtest/gtest.h>

#include <vector>

namespace pdc::detail {
namespace {

TEST(ContourableGrids, AreNamedInOrder) { EXPECT_EQ(contourableTypeNames(), "float, double, int32, int64 and bool"); }

TEST(ContourableGrids, AreVisitedAsWhatTheyAre) {
  std::vector<openvdb::GridBase::Ptr> grids;
  forEachContourableType([&]<typename GridT>(std::type_identity<GridT>) { grids.push_back(GridT::create()); });
  ASSERT_EQ(grids.size(), 5u);
  for (const auto& grid : grids) {
    std::string visited;
    EXPECT_TRUE(visitContourable(*grid, [&]<typename GridT>(const GridT&) { visited = GridT::gridType(); }));
    EXPECT_EQ(visited, grid->type());
  }
}

TEST(ContourableGrids, VectorsAreNotVisited) {
  const auto vectors = openvdb::Vec3SGrid::create();
  EXPECT_FALSE(visitContourable(*vectors, [](const auto&) { FAIL() << "visited"; }));
}

}  // namespace
}  // namespace pdc::detail
