#include "mesh/polygons/concave_quads.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace pdc::detail {
namespace {

Quad turned(const Buffer<Vec3f>& positions, const Quad& quad) {
  Mesh mesh;
  mesh.positions = positions;
  mesh.quads = {quad};
  turnConcaveQuads(mesh);
  return mesh.quads[0];
}

TEST(ConcaveQuads, BeginWithACornerThatSplitsThem) {
  // The third corner is reflex.
  const Buffer<Vec3f> arrow{{0, 2, 0}, {-1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  EXPECT_EQ(turned(arrow, {0, 1, 2, 3}), (Quad{0, 1, 2, 3}));
  EXPECT_EQ(turned(arrow, {2, 3, 0, 1}), (Quad{2, 3, 0, 1}));
  EXPECT_EQ(turned(arrow, {1, 2, 3, 0}), (Quad{2, 3, 0, 1}));
  EXPECT_EQ(turned(arrow, {3, 0, 1, 2}), (Quad{0, 1, 2, 3}));
  EXPECT_EQ(turned(arrow, {3, 2, 1, 0}), (Quad{2, 1, 0, 3})) << "from the other side";
}

TEST(ConcaveQuads, ACornerWithinAStraightEdgeIsNoneToLeaveOut) {
  const Buffer<Vec3f> triangle{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  EXPECT_EQ(turned(triangle, {0, 1, 2, 3}), (Quad{1, 2, 3, 0}));
  EXPECT_EQ(turned(triangle, {1, 2, 3, 0}), (Quad{1, 2, 3, 0}));
}

TEST(ConcaveQuads, OthersStay) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::array<Buffer<Vec3f>, 6> shapes{{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
      {{-1, 0, 0}, {0, -0.026f, -0.1f}, {1, 0, 0}, {0, 0.26f, -1}},  // folded over a sharp crease
      {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},                  // crosses itself
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
      {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}},
      {{0, 2, 0}, {-1, 0, 0}, {nan, 1, 0}, {1, 0, 0}},
  }};
  for (const Buffer<Vec3f>& shape : shapes) EXPECT_EQ(turned(shape, {0, 1, 2, 3}), (Quad{0, 1, 2, 3}));
}

}  // namespace
}  // namespace pdc::detail
