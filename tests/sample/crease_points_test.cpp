#include "pdc/sample/crease_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "pdc/sample/implicit/field_source.h"
#include "sample/creases/noisy_part.h"

namespace pdc {
namespace {

FieldSource sourceOf(const FieldPtr& field, double voxelSize = 0.05) {
  return {field, {.box = test::kDrilledBoxBounds, .voxelSize = voxelSize}};
}

// All edges of the box and the two rims of the hole, and nothing else.
TEST(CreasePoints, LieOnTheEdgesOfTheBoxAndTheRimsOfTheHole) {
  const FieldSource source = sourceOf(test::drilledBox(), 0.07);
  const std::vector<Vec3f> points = creasePoints(source.levelField(), source);
  std::size_t onRims = 0;
  for (const Vec3f& p : points) {
    const double x = std::abs(std::abs(double(p.x)) - 1), y = std::abs(std::abs(double(p.y)) - 1);
    const double z = std::abs(std::abs(double(p.z)) - 0.5), rim = std::abs(std::hypot(double(p.x), double(p.y)) - 0.6);
    const double onBox = std::min({std::hypot(x, y), std::hypot(y, z), std::hypot(z, x)});
    onRims += std::hypot(rim, z) < 1e-4;
    EXPECT_LT(std::min(onBox, std::hypot(rim, z)), 1e-4) << p.x << " " << p.y << " " << p.z;
  }
  // Lengths in voxels: 20 of edges, 2 rims of 2 π 0.6.
  EXPECT_GT(static_cast<double>(points.size() - onRims), 0.8 * 20 / 0.07);
  EXPECT_GT(static_cast<double>(onRims), 0.8 * 2 * 2 * 3.14159 * 0.6 / 0.07);
}

TEST(CreasePoints, ASmoothSurfaceHasNone) {
  const FieldSource source = sourceOf(sphere({0, 0, 0}, 0.2), 0.15);
  EXPECT_TRUE(creasePoints(source.levelField(), source).empty());
  EXPECT_THROW(static_cast<void>(creasePoints(nullptr, source)), std::invalid_argument);
}

}  // namespace
}  // namespace pdc
