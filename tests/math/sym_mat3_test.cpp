#include "pdc/math/sym_mat3.h"

#include <gtest/gtest.h>

#include "math/random_geometry.h"

namespace pdc {
namespace {

TEST(SymMat3, ProductsAreTheirDefinitions) {
  RandomGeometry random(1);
  for (int i = 0; i < 100; ++i) {
    const auto A = random.covariance(1), B = random.covariance(1);
    const Mat3d K = random.matrix();
    const Vec3d v = random.point(), x = random.point();
    EXPECT_NEAR(quadraticForm(congruence(A, K), x), quadraticForm(A, K * x), 1e-10);
    EXPECT_NEAR(quadraticForm(crossSquare(v, 0.5), x), 0.5 * dot(cross(v, x), cross(v, x)), 1e-11);
    double trace = 0;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) trace += A(r, c) * B(c, r);
    EXPECT_NEAR(traceOfProduct(A, B), trace, 1e-12 * trace);
    EXPECT_EQ(A.plusDiagonal(2), A + SymMat3<double>::identity() * 2.0);
  }
}

}  // namespace
}  // namespace pdc
