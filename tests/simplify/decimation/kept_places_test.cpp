// What decimation does to the bits of places, and to places that single precision can hardly hold.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "pdc/simplify/decimate.h"
#include "mesh/local/local_frame.h"
#include "simplify/shapes.h"

namespace pdc {
namespace {

std::set<std::array<float, 3>> placesOf(const Mesh& mesh) {
  std::set<std::array<float, 3>> places;
  for (const Vec3f& p : mesh.positions) places.insert({p.x, p.y, p.z});
  return places;
}

/// A torus that lies in z from -0.4 to 0.1, with coordinates of 1e-17 where its circles pass z = 0.
Mesh lopsidedTorus() {
  Mesh ring = test::torus(20);
  for (Vec3f& p : ring.positions) p.z = std::min(p.z, 0.1F + 0.01F * p.z);
  return ring;
}

TEST(KeptPlaces, SubsetHasAllBitsOfWhatWasGiven) {
  const Mesh ring = lopsidedTorus();
  const std::set<std::array<float, 3>> given = placesOf(ring);
  ASSERT_TRUE(std::any_of(given.begin(), given.end(), [](const auto& p) {
    return p[2] != 0 && std::abs(p[2]) < 1e-15F;
  })) << "or the test shows nothing";
  for (const bool sound : {false, true}) {
    const Mesh fewer = decimate(ring, {.ratio = 0.3, .placement = CollapsePlacement::kSubset, .sound = sound});
    EXPECT_LE(fewer.triangles.size(), 3 * ring.triangles.size() / 10);
    for (const auto& p : placesOf(fewer)) EXPECT_TRUE(given.contains(p)) << p[0] << ' ' << p[1] << ' ' << p[2];
  }
}

TEST(KeptPlaces, VerticesThatStayHaveAllBits) {
  const Mesh ring = lopsidedTorus();
  EXPECT_EQ(placesOf(decimate(ring, {.ratio = 1, .fit = false})), placesOf(ring));
}

// A vertex far away does not cost the others their digits: near it steps of double precision are 1e4.
TEST(KeptPlaces, VertexFarAwayLeavesTheOthersAlone) {
  Mesh ball = test::sphere(20);
  ball.positions[100] = {1e20F, 0, 0};
  const Mesh fewer = decimate(ball, {.ratio = 0.2});
  EXPECT_LE(fewer.triangles.size(), ball.triangles.size() / 5);
  std::size_t away = 0;
  for (const Vec3f& p : fewer.positions) away += std::abs(length(vecCast<double>(p)) - 1) > 0.05;
  EXPECT_LE(away, 2u);
}

TEST(KeptPlaces, NothingLeavesSinglePrecision) {
  Mesh mesh = test::cube(2);
  for (Vec3f& p : mesh.positions) p *= std::numeric_limits<float>::max();
  const detail::LocalFrame frame(mesh, mesh.triangles);
  for (const Vec3f& p : mesh.positions) {
    EXPECT_EQ(frame.world(frame.local(p)), p);
    EXPECT_EQ(frame.world(frame.local(p) * 3), p) << "the nearest that there is";
  }
}

}  // namespace
}  // namespace pdc
