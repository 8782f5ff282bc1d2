#include "pdc/sample/lattice_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "pdc/error.h"

namespace pdc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(LatticeMap, AffineMapsPointsAndDirections) {
  const Mat3d linear{{Vec3d{0, -2, 0}, Vec3d{3, 0, 0.5}, Vec3d{0, 0, 4}}};
  const LatticeMap map(linear, {10, 20, 30});
  EXPECT_TRUE(map.affine());
  EXPECT_EQ(map.position({0, 0, 0}), (Vec3d{10, 20, 30}));
  EXPECT_EQ(map.position({1, 2, 3}), (Vec3d{6, 24.5, 42}));
  EXPECT_EQ(map.jacobian({7, 7, 7}).column(2), (Vec3d{0, 0.5, 4}));
  EXPECT_FALSE(map.mirrored());
  EXPECT_NEAR(map.voxelSize(), std::cbrt(24.0), 1e-14);
}

TEST(LatticeMap, MirroredIfTheDeterminantIsNegative) {
  EXPECT_TRUE(LatticeMap(Mat3d::diagonal(1, -1, 1), {}).mirrored());
  EXPECT_FALSE(LatticeMap(Mat3d::diagonal(-1, -1, 1), {}).mirrored());
}

TEST(LatticeMap, ScaleAloneIsNeverSingular) {
  for (const double size : {1e-100, 1e-7, 1e7, 1e100}) {
    const LatticeMap map(Mat3d::diagonal(size, size, size), {});
    EXPECT_NEAR(map.voxelSize() / size, 1, 1e-14);
  }
}

TEST(LatticeMap, SingularAndNonFiniteMapsAreErrors) {
  EXPECT_THROW(LatticeMap(Mat3d::diagonal(1, 0, 1), {}), Error);
  EXPECT_THROW(LatticeMap(Mat3d::diagonal(1, kNan, 1), {}), Error);
  EXPECT_THROW(LatticeMap(Mat3d::diagonal(1, 1, std::numeric_limits<double>::infinity()), {}), Error);
  EXPECT_THROW(LatticeMap(Mat3d::identity(), {0, 0, kNan}), Error);
  const Mat3d flat{{Vec3d{1, 2, 3}, Vec3d{2, 4, 6}, Vec3d{0, 1, 1}}};
  EXPECT_THROW(LatticeMap(flat, {}), Error);
}

TEST(LatticeMap, CurvedMapUsesItsFunctions) {
  const auto position = [](const Vec3d& p) { return Vec3d{p.x * p.z, p.y * p.z, -p.z}; };
  const auto jacobian = [](const Vec3d& p) { return Mat3d{{Vec3d{p.z, 0, p.x}, Vec3d{0, p.z, p.y}, Vec3d{0, 0, -1}}}; };
  const LatticeMap map(position, jacobian, {0, 0, 8});
  EXPECT_FALSE(map.affine());
  EXPECT_EQ(map.position({1, 2, 3}), (Vec3d{3, 6, -3}));
  EXPECT_EQ(map.jacobian({1, 2, 3}).column(2), (Vec3d{1, 2, -1}));
  EXPECT_TRUE(map.mirrored());
  EXPECT_NEAR(map.voxelSize(), 4, 1e-14);
  EXPECT_THROW(LatticeMap(position, jacobian, {0, 0, 0}), Error);
  EXPECT_THROW(LatticeMap(nullptr, jacobian, {}), std::invalid_argument);
  EXPECT_THROW(LatticeMap(position, nullptr, {}), std::invalid_argument);
}

}  // namespace
}  // namespace pdc
