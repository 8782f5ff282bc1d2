#include "points/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <vector>

#include "points/point_shapes.h"
#include "points/spatial_order.h"

namespace pdc::detail {
namespace {

TEST(PointTree, FindsThePointsWithinARadiusThatALoopOverAllFinds) {
  const PointCloud cloud = test::noisySphere(3001, 0.1);
  const PointTree tree(cloud.positions);
  for (const double radius : {0.0, 0.05, 0.7, 5.0}) {
    for (std::uint32_t c = 0; c < 3001; c += 500) {
      std::vector<std::uint32_t> found, expected;
      tree.visitWithin(cloud.positions[c], radius, [&](std::uint32_t i, double) { found.push_back(i); });
      for (std::uint32_t i = 0; i < 3001; ++i) {
        const Vec3d d = cloud.positions[i] - cloud.positions[c];
        if (dot(d, d) <= radius * radius) expected.push_back(i);
      }
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(PointTree, KnowsTheDistanceToTheKthNearest) {
  const PointCloud cloud = test::noisySphere(1000, 0.1);
  const PointTree tree(cloud.positions);
  const Vec3d centre{0.3, 0.2, 0.9};
  std::vector<double> all;
  for (const Vec3d& p : cloud.positions) all.push_back(dot(p - centre, p - centre));
  std::sort(all.begin(), all.end());
  for (const std::size_t k : {1, 2, 9, 1000}) EXPECT_EQ(tree.squaredDistanceToNearest(centre, k), all[k - 1]);
  EXPECT_EQ(tree.squaredDistanceToNearest(centre, 1001), std::numeric_limits<double>::infinity());
}

TEST(SpatialOrder, DoesNotDependOnTheOrderOfThePoints) {
  const PointCloud cloud = test::noisySphere(5000, 0.1);
  Buffer<Vec3d> reversed(cloud.positions.rbegin(), cloud.positions.rend());
  const auto sorted = [](const Buffer<Vec3d>& points) {
    return inOrder(points, spatialOrder(points, std::less<std::uint32_t>()));
  };
  EXPECT_EQ(sorted(cloud.positions), sorted(reversed));
  EXPECT_NE(sorted(cloud.positions), cloud.positions);
}

}  // namespace
}  // namespace pdc::detail
