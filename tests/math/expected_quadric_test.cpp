#include "pdc/math/expected_quadric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/quadric_checks.h"
#include "math/random_geometry.h"

namespace pdc {
namespace {

TEST(ExpectedQuadric, OfNothingIsZeroAndOfOneIsItself) {
  const auto f = pointQuadric(Vec3d{1, 2, 3});
  const auto none = sampleExpectedQuadric(0, [&] { return f; });
  EXPECT_EQ(none.mean, Quadric<double>::zero());
  const auto one = sampleExpectedQuadric(1, [&] { return f; });
  EXPECT_EQ(one.mean, f);
  EXPECT_EQ(one.standardError, Quadric<double>::zero());
}

TEST(ExpectedQuadric, GivesMeanAndStandardErrorOfAList) {
  int k = 0;
  // c = 1, 2, 3, 4: mean 2.5, variance 5/3.
  const auto sampled = sampleExpectedQuadric(4, [&] {
    ++k;
    return Quadric<double>{SymMat3<double>::zero(), Vec3d{}, static_cast<double>(k)};
  });
  EXPECT_DOUBLE_EQ(sampled.mean.c, 2.5);
  EXPECT_DOUBLE_EQ(sampled.standardError.c, std::sqrt(5.0 / 3 / 4));
  EXPECT_EQ(sampled.standardError.b, Vec3d{});
}

// Unit normals uniform in a cap about z, of half angle a: E[nnᵀ] has no closed form among the factories, but one of its
// own.
TEST(ExpectedQuadric, OfNormalsInACapIsItsIntegral) {
  RandomGeometry random(1);
  const double cosine = std::cos(0.5);
  const Vec3d q{0.2, -0.4, 0.6};
  const auto sampled = sampleExpectedQuadric(1'000'000, [&] {
    const double z = random.uniform(cosine, 1), turn = random.uniform(0, 2 * M_PI), s = std::sqrt(1 - z * z);
    return planeQuadric(q, {s * std::cos(turn), s * std::sin(turn), z});
  });
  const double zz = (1 + cosine + cosine * cosine) / 3, xx = (1 - zz) / 2;
  const SymMat3<double> A{xx, 0, 0, xx, 0, zz};
  expectIsTheMean(sampled, {A, A * q, quadraticForm(A, q)}, 1e-3);
}

TEST(ExpectedQuadric, SameDrawsGiveTheSameBits) {
  const auto draw = [] {
    RandomGeometry random(2);
    return sampleExpectedQuadric(1000, [&] { return planeQuadric(random.point(), random.direction()); });
  };
  EXPECT_EQ(draw().mean, draw().mean);
  EXPECT_EQ(draw().standardError, draw().standardError);
}

}  // namespace
}  // namespace pdc
