#include "pdc/mesh/minimum_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pdc/error.h"

namespace pdc::test {
namespace {

TEST(MinimumAngles, OfKnownTriangles) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0},
                    {0, 1, 0}, {0.5F, std::sqrt(0.75F), 0},
                    {2, 0, 0}, {std::numeric_limits<float>::infinity(), 0, 0},
                    {1, 1, 0}};
  mesh.quads = {{0, 1, 6, 2}};
  mesh.triangles = {{0, 1, 3}, {0, 1, 4}, {0, 0, 1}, {0, 1, 5}};
  const Buffer<float> angles = minimumAngles(mesh);
  ASSERT_EQ(angles.size(), 6u);
  EXPECT_NEAR(angles[0], 45, 1e-4);
  EXPECT_NEAR(angles[1], 45, 1e-4);
  EXPECT_NEAR(angles[2], 60, 1e-4);
  EXPECT_EQ(angles[3], 0);
  EXPECT_EQ(angles[4], 0);
  EXPECT_TRUE(std::isnan(angles[5]));
  mesh.triangles = {{0, 1, 7}};
  EXPECT_THROW(static_cast<void>(minimumAngles(mesh)), Error);
}

}  // namespace
}  // namespace pdc::test
