#include "sample/distance_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sample/kinks.h"
#include "sample/voxel_planes.h"

namespace pdc::detail {
namespace {

constexpr PlaneTolerance kTolerance{.error = 0.04F, .usual = 0.001F, .kink = 0.01F};

Vec3d unit(Vec3d v) { return v * (1 / length(v)); }

const Vec3d kLeft = unit({-0.8, 0.3, 0.5}), kRight = unit({0.7, 0.4, 0.6});
const Vec3d kTip{4.3, 4.2, 4.4};

/// The distance to the solid between two planes that meet at kTip, as its inside and the parts before its faces see it;
/// beyond them the edge is nearest.
double wedge(const Vec3d& p) {
  const double a = dot(p - kTip, kLeft), b = dot(p - kTip, kRight);
  const Vec3d onLeft = p - kLeft * a, onRight = p - kRight * b;
  if (dot(onLeft - kTip, kRight) <= 0 || dot(onRight - kTip, kLeft) <= 0 || std::max(a, b) <= 0) return std::max(a, b);
  const Vec3d along = unit(cross(kLeft, kRight)), d = p - kTip;
  return length(d - along * dot(d, along));
}

double ball(const Vec3d& p) { return length(p - Vec3d{-9, 3, 2}) - 13; }

DistanceWindow window(const std::function<double(const Vec3d&)>& distance) {
  DistanceWindow w;
  for (int x = -3; x <= 11; ++x)
    for (int y = -3; y <= 11; ++y)
      for (int z = -3; z <= 11; ++z)
        w.value[DistanceWindow::index(x, y, z)] = static_cast<float>(distance({double(x), double(y), double(z)}));
  return w;
}

double degrees(const Vec3f& a, const Vec3d& b) {
  return std::acos(std::min(1.0, dot(vecCast<double>(a), b))) * 180 / 3.14159265358979323846;
}

TEST(VoxelPlanes, APlaneIsFoundExactly) {
  const auto w = window([](const Vec3d& p) { return dot(p - kTip, kLeft); });
  const VoxelPlanes planes = voxelPlanes(w, {5, 4, 3}, kTolerance, Mat3f::identity());
  ASSERT_EQ(planes.count, 1);
  EXPECT_LT(degrees(planes.plane[0].normal, kLeft), 0.05);
  EXPECT_NEAR(dot(vecCast<double>(planes.plane[0].foot) - kTip, kLeft), 0, 1e-5);
  EXPECT_GT(planes.plane[0].weight, 0.99F);
}

TEST(VoxelPlanes, BesideAnEdgeTrustedPlanesAreThoseOfItsSides) {
  const auto w = window(wedge);
  int left = 0, right = 0;
  for (int x = 2; x <= 6; ++x)
    for (int y = 2; y <= 6; ++y)
      for (int z = 2; z <= 6; ++z) {
        const VoxelPlanes planes = voxelPlanes(w, {x, y, z}, kTolerance, Mat3f::identity());
        for (int i = 0; i < planes.count; ++i) {
          const SurfaceSample& s = planes.plane[i];
          if (s.trust < 0.5F) continue;
          const bool isLeft = degrees(s.normal, kLeft) < 1, isRight = degrees(s.normal, kRight) < 1;
          left += isLeft;
          right += isRight;
          const Vec3d foot = vecCast<double>(s.foot) - kTip;
          // What is nearest to the edge says something true as well: a plane through the edge.
          const Vec3d along = unit(cross(kLeft, kRight));
          const bool edge = length(foot - along * dot(foot, along)) < 0.05;
          EXPECT_TRUE(isLeft || isRight || edge) << x << ' ' << y << ' ' << z;
        }
      }
  EXPECT_GT(left, 15);
  EXPECT_GT(right, 15);
}

TEST(VoxelPlanes, StretchedLatticesGiveTheSamePlanes) {
  // One lattice step along x is half a voxel, along y two.
  const auto w = window([](const Vec3d& p) { return dot(Vec3d{0.5 * p.x, 2 * p.y, p.z} - kTip, kLeft); });
  const VoxelPlanes planes = voxelPlanes(w, {5, 4, 3}, kTolerance, Mat3f::diagonal(2, 0.5F, 1));
  ASSERT_EQ(planes.count, 1);
  EXPECT_LT(degrees(planes.plane[0].normal, kLeft), 0.05);
  const Vec3d foot = vecCast<double>(planes.plane[0].foot);
  EXPECT_NEAR(dot(Vec3d{0.5 * foot.x, 2 * foot.y, foot.z} - kTip, kLeft), 0, 1e-5);
}

TEST(VoxelPlanes, WhatIsNoDistanceGivesNone) {
  const auto w = window([](const Vec3d& p) { return 1.3 * dot(p - kTip, kLeft); });
  EXPECT_EQ(voxelPlanes(w, {5, 4, 3}, kTolerance, Mat3f::identity()).count, 0);
}

TEST(Kinks, SmoothSurfacesHaveNone) {
  const Kinks kinks = findKinks(window(ball), kTolerance.kink);
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z) EXPECT_TRUE(kinks.noneAbout({x, y, z}));
}

TEST(Kinks, CellsAtAnEdgeHaveSome) {
  const Kinks kinks = findKinks(window(wedge), kTolerance.kink);
  EXPECT_FALSE(kinks.noneAbout({4, 4, 4}));
}

TEST(Kinks, DoNotDependOnTheProcessor) {
  const DistanceWindow w = window(wedge);
  const Kinks best = findKinks(w, kTolerance.kink), baseline = findKinks(w, kTolerance.kink, SimdLevel::kBaseline);
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z) EXPECT_EQ(best.noneAbout({x, y, z}), baseline.noneAbout({x, y, z}));
}

}  // namespace
}  // namespace pdc::detail
