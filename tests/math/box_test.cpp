#include "pdc/math/box.h"

#include <gtest/gtest.h>

namespace pdc {
namespace {

TEST(Box, GrowsFromNothingByWhatItIncludes) {
  Box box = Box::empty();
  EXPECT_TRUE(box.isEmpty());
  box.include(Vec3d{1, 2, 3});
  EXPECT_FALSE(box.isEmpty());
  EXPECT_EQ(box, (Box{{1, 2, 3}, {1, 2, 3}}));
  box.include(Box{{0, 5, -1}, {4, 6, 0}});
  EXPECT_EQ(box, (Box{{0, 2, -1}, {4, 6, 3}}));
  box.include(Box::empty());
  EXPECT_EQ(box, (Box{{0, 2, -1}, {4, 6, 3}}));
}

TEST(Box, MeetsWhatTouchesItOnEachAxis) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Box other = box;
      other.lo[axis] += side;
      other.hi[axis] += side;
      EXPECT_TRUE(box.meets(other)) << axis;
      other.lo[axis] += 0.25 * side;
      other.hi[axis] += 0.25 * side;
      EXPECT_FALSE(box.meets(other)) << axis;
    }
  EXPECT_TRUE(box.meets({{0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}})) << "one within the other";
  EXPECT_FALSE(box.meets(Box::empty()));
}

TEST(Box, SquaredDistanceIsThatToItsNearestPoint) {
  const BoxF box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(box.squaredDistance({0.5, 2, 0}), 0);
  EXPECT_EQ(box.squaredDistance({4, 1, 1}), 9);
  EXPECT_EQ(box.squaredDistance({-1, 4, 5}), 1 + 4 + 4);
}

TEST(Box, CentreAndRadius) {
  const Box box{{-1, 0, 0}, {1, 4, 4}};
  EXPECT_EQ(box.center(), (Vec3d{0, 2, 2}));
  EXPECT_EQ(box.halfSize(), (Vec3d{1, 2, 2}));
  EXPECT_EQ(box.radius(), 3);
}

TEST(Box, RadiusReachesItsCorners) {
  const Box box{{1, -2, 0}, {3, 2, 4}};
  EXPECT_EQ(box.center(), (Vec3d{2, 0, 2}));
  EXPECT_EQ(box.halfSize(), (Vec3d{1, 2, 2}));
  EXPECT_EQ(box.radius(), 3);
}

}  // namespace
}  // namespace pdc
