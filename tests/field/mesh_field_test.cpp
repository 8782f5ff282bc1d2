#include "pdc/field/mesh_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "field/field_checks.h"
#include "mesh/winding/cubes.h"
#include "pdc/error.h"
#include "pdc/field/primitives.h"

namespace pdc {
namespace {

using test::FieldCase;
using test::Random;

const Box kNearby{{-1, -1, -1}, {2, 2, 2}};

Mesh farCube() {
  Mesh mesh = test::cube();
  mesh.origin = {0.5, -0.25, 0.125};
  return mesh;
}

std::vector<FieldCase> meshes() {
  return {{"cube", meshField(test::cube()), true, 1, kNearby},
          {"insideOut", meshField(test::insideOut(test::cube())), true, 1, kNearby},
          {"movedByItsOrigin", meshField(farCube()), true, 1, kNearby}};
}

class MeshField : public testing::TestWithParam<FieldCase> {};

TEST_P(MeshField, BoundsHold) { test::expectBoundsHold(GetParam()); }
TEST_P(MeshField, BoundsConverge) { test::expectBoundsConverge(GetParam()); }
TEST_P(MeshField, BatchesAgree) { test::expectBatchesAgree(GetParam()); }
TEST_P(MeshField, GradientsMatchDifferences) { test::expectGradientsMatchDifferences(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, MeshField, testing::ValuesIn(meshes()), testing::PrintToStringParamName());

TEST(MeshField, OfACubeIsItsDistance) {
  const FieldPtr mesh = meshField(test::cube()), exact = box({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5});
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p = random.in(kNearby);
    EXPECT_NEAR(mesh->valueAt(p), exact->valueAt(p), 1e-12);
    EXPECT_LT(length(mesh->gradientAt(p) - exact->gradientAt(p)), 1e-9);
  }
}

TEST(MeshField, HoldsItsBoundaryAndHasItsNormal) {
  const FieldPtr field = meshField(test::cube());
  for (const Vec3d& p : {Vec3d{0.25, 0.5, 0}, {0.25, 0.5, 1}, {1, 0.25, 0.5}, {0, 0.5, 0.75}}) {
    EXPECT_TRUE(isInside(field->valueAt(p)));
    const Vec3d g = field->gradientAt(p);
    EXPECT_NEAR(length(g), 1, 1e-12);
    EXPECT_FALSE(isInside(field->valueAt(p + g * 1e-3)));
    EXPECT_NEAR(field->valueAt(p - g * 1e-3), -1e-3, 1e-12);
  }
}

TEST(MeshField, ClosesAHoleWhereTheWindingNumberIsAHalf) {
  const FieldPtr field = meshField(test::openCube());
  EXPECT_LT(field->valueAt({0.5, 0.5, 0.3}), 0);
  EXPECT_GT(field->valueAt({0.5, 0.5, 1.3}), 0);
  double low = 0.3, high = 1.3;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (field->valueAt({0.5, 0.5, middle}) < 0 ? low : high) = middle;
  }
  // Halfway across the level the value is small, and the gradient looks out of the hole.
  EXPECT_NEAR(field->valueAt({0.5, 0.5, low}), 0, 1e-6);
  EXPECT_NEAR(field->gradientAt({0.5, 0.5, low}).z, 1, 1e-3);
  EXPECT_TRUE(std::isinf(field->lipschitz()));
  test::expectBoundsHold({"openCube", field, false, 1, kNearby});
}

TEST(MeshField, NeedsATriangle) { EXPECT_THROW(static_cast<void>(meshField(Mesh{})), Error); }

}  // namespace
}  // namespace pdc
