#include "extract/vertices/patch_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "pdc/math/mat3.h"

namespace pdc::detail {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

PatchSamples samplesOf(const std::vector<Vec3d>& points, const std::vector<Vec3d>& normals) {
  PatchSamples s;
  for (std::size_t i = 0; i < points.size(); ++i) {
    s.position[i] = points[i];
    s.row[i] = normals[i];
  }
  s.size = static_cast<int>(points.size());
  return s;
}

const CellMetric kCube(Mat3d::identity(), 1);

TEST(ChordResidual, IsZeroOnASphereOfAnySize) {
  for (const double radius : {0.5, 2.0, 100.0}) {
    std::vector<Vec3d> points, normals;
    for (const double a : {0.0, 0.2, 0.45}) {
      normals.push_back(
          {std::cos(a / radius), std::sin(a / radius) * std::cos(9 * a), std::sin(a / radius) * std::sin(9 * a)});
      points.push_back(normals.back() * radius);
    }
    EXPECT_LT(chordResidual(samplesOf(points, normals), kCube), 1e-20) << radius;
  }
}

// Two planes, one point on each, at a and b from the edge: s = 2 sin α (a − b) / (a + b), where each leans by α.
TEST(ChordResidual, IsThatOfTheEdge) {
  const double alpha = 40 * kDegree, a = 0.4, b = 0.1;
  const Vec3d left{-std::sin(alpha), std::cos(alpha), 0}, right{std::sin(alpha), std::cos(alpha), 0};
  const PatchSamples s =
      samplesOf({Vec3d{-std::cos(alpha), -std::sin(alpha), 0} * a, Vec3d{std::cos(alpha), -std::sin(alpha), 0} * b},
                {left, right});
  // The chord is not level: its ends lie at different heights.
  const Vec3d chord = s.position[1] - s.position[0];
  const double across = dot(left + right, chord) / length(chord);
  EXPECT_NEAR(chordResidual(s, kCube), across * across / 2, 1e-12);
  EXPECT_GT(chordResidual(s, kCube), 0.1);
}

TEST(ChordResidual, TheMetricDoesNotMatter) {
  const Mat3d M{{Vec3d{1.3, 0.2, 0}, Vec3d{-0.1, 0.7, 0.3}, Vec3d{0, 0.4, 1.1}}}, K = inverse(M);
  const std::vector<Vec3d> points{{0.1, 0.2, 0}, {0.3, -0.2, 0.1}, {-0.2, 0, 0.4}},
      normals{{1, 0, 0}, {0.6, 0.8, 0}, {0, 0.6, 0.8}};
  std::vector<Vec3d> latticePoints, rows;
  for (std::size_t i = 0; i < points.size(); ++i) {
    latticePoints.push_back(K * points[i]);
    rows.push_back(M.transposed() * normals[i]);
  }
  EXPECT_NEAR(chordResidual(samplesOf(latticePoints, rows), CellMetric(M, 1)),
              chordResidual(samplesOf(points, normals), kCube), 1e-12);
}

TEST(ChordResidual, PointsInOnePlaceSayNothing) {
  EXPECT_EQ(chordResidual(samplesOf({{0, 0, 0}, {0, 0, 0}}, {{1, 0, 0}, {0, 1, 0}}), kCube), 0);
}

}  // namespace
}  // namespace pdc::detail
