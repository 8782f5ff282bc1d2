#include "simplify/clustering/representative.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pdc::detail {
namespace {

constexpr double kTilt = 0.1;

/// A cell with one corner at `mean` and the planes x = z / 10 + a and x = b − z / 10, which meet in a line along y at
/// z = 5 (b − a).
CellSums sums(double a, double b, const Vec3d& mean) {
  const double l = std::sqrt(1 + kTilt * kTilt);
  const auto error = planeQuadric(Vec3d{a, 0, 0}, Vec3d{1, 0, -kTilt} * (1 / l)) +
                     planeQuadric(Vec3d{b, 0, 0}, Vec3d{1, 0, kTilt} * (1 / l));
  return {0, error.normalEquations(), mean, 1};
}

void expectNear(const Vec3d& a, const Vec3d& b, double tolerance) {
  EXPECT_LT(length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

const RepresentativeRule kInCell({.cell = 1, .quadric = QuadricKind::kPlane});
const RepresentativeRule kFree({.cell = 1, .quadric = QuadricKind::kPlane, .free = true});

TEST(Representative, ClassicalMinimumIsNearestToTheMean) {
  const Representative r = representative(sums(0, 0.05, {0.3, 0.2, 0.1}), kInCell);
  expectNear(r.place, {0.025, 0.2, 0.25}, 1e-9);
  EXPECT_FALSE(r.outside);
}

TEST(Representative, SmallEigenvaluesLeaveDirectionsOpen) {
  // Planes at 1 / 50 to each other are one plane, as far as it goes.
  const double l = std::sqrt(1 + 1e-4);
  const auto error =
      planeQuadric(Vec3d{}, Vec3d{1, 0, -0.01} * (1 / l)) + planeQuadric(Vec3d{}, Vec3d{1, 0, 0.01} * (1 / l));
  expectNear(representative({0, error.normalEquations(), {0.4, 0.3, 0.2}, 1}, kInCell).place, {0, 0.3, 0.2}, 1e-9);
}

TEST(Representative, IsDrawnBackAlongThePlanes) {
  const CellSums far = sums(0, 0.2, {0.1, 0.2, 0});  // The planes meet at z = 1.
  const Representative inside = representative(far, kInCell);
  EXPECT_TRUE(inside.outside);
  expectNear(inside.place, {0.1, 0.2, 0.5}, 1e-4);
  const Representative free = representative(far, kFree);
  EXPECT_TRUE(free.outside);
  expectNear(free.place, {0.1, 0.2, 1}, 1e-9);
  // At z = 4 even free ones do not arrive.
  expectNear(representative(sums(0, 0.8, {0.1, 0.2, 0}), kFree).place, {0.4, 0.2, 2}, 1e-4);
}

TEST(Representative, StaysOnALineThatCrossesTheCell) {
  // The line z = 3y in x = 0, whose place nearest to the mean lies above the cell.
  const auto error =
      planeQuadric(Vec3d{}, Vec3d{1, 0, 0}) + planeQuadric(Vec3d{}, Vec3d{0, 3, -1} * (1 / std::sqrt(10)));
  const Representative r = representative({0, error.normalEquations(), {0, 0.5, 0.45}, 1}, kInCell);
  EXPECT_TRUE(r.outside);
  expectNear(r.place, {0, 1.0 / 6, 0.5}, 1e-4);
}

TEST(Representative, NoiseHoldsWhatPlanesLeaveOpen) {
  CellSums noisy = sums(0, 0.05, {9, 9, 9});
  const Vec3d center{0.025, 0.2, 0.25};
  noisy.error += {SymMat3<double>::identity() * 0.01, center * 0.01};
  expectNear(representative(noisy, RepresentativeRule({.cell = 1})).place, center, 1e-9);
}

TEST(Representative, WithoutQuadricsItIsTheMean) {
  const CellSums none{0, NormalEquations<double>::zero(), {0.3, -0.6, 0.9}, 3};
  for (const QuadricKind kind : {QuadricKind::kPlane, QuadricKind::kProbabilisticPlane, QuadricKind::kPoint}) {
    const RepresentativeRule rule({.cell = 1, .quadric = kind});
    expectNear(representative(none, rule).place, {0.1, -0.2, 0.3}, 1e-12);
  }
}

}  // namespace
}  // namespace pdc::detail
