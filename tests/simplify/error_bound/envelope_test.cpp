#include "simplify/error_bound/envelope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "simplify/shapes.h"

namespace pdc::detail {
namespace {

constexpr std::uint32_t kNone = Envelope::kNone;

/// Two slopes that meet in the ridge x = 0 at height 1 and fall to 0 at |x| = 1, for y from 0 to 1.
Mesh roof() {
  Mesh mesh;
  mesh.positions = {{-1, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 1}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  return mesh;
}

TEST(Envelope, HoldsWhatIsWithinTheDistanceOfFlatTriangles) {
  const Mesh flat = test::plate(7);
  const Envelope envelope(flat, 0.1);
  // It spans many triangles, and none of them alone is near to all of it.
  EXPECT_TRUE(envelope.contains({Vec3d{0.05, 0.05, 0.099}, {0.95, 0.1, 0.099}, {0.4, 0.9, -0.099}}, kNone));
  EXPECT_FALSE(envelope.contains({Vec3d{0.05, 0.05, 0.099}, {0.95, 0.1, 0.101}, {0.4, 0.9, -0.099}}, kNone));
}

TEST(Envelope, ReachesBeyondTheBoundaryByTheDistance) {
  const Mesh flat = test::plate(7);
  const Envelope envelope(flat, 0.1);
  EXPECT_TRUE(envelope.contains({Vec3d{0.5, 0.5, 0}, {1.099, 0.4, 0}, {1.099, 0.6, 0}}, kNone));
  EXPECT_FALSE(envelope.contains({Vec3d{0.5, 0.5, 0}, {1.101, 0.4, 0}, {1.101, 0.6, 0}}, kNone));
}

TEST(Envelope, FindsWhatIsOutsideBetweenCornersThatAreInside) {
  const Mesh ridge = roof();
  // Its corners are on the slopes, its middle is 0.5 below the ridge, 0.35 from either slope.
  const TrianglePoints below{Vec3d{-0.5, 0.2, 0.5}, {0.5, 0.2, 0.5}, {0, 0.8, 0.5}};
  EXPECT_FALSE(Envelope(ridge, 0.35).contains(below, kNone));
  EXPECT_TRUE(Envelope(ridge, 0.36).contains(below, kNone));
}

TEST(Envelope, RoundsRidges) {
  const Mesh ridge = roof();
  const TrianglePoints above{Vec3d{-0.02, 0.1, 1.09}, {0.02, 0.1, 1.09}, {0, 0.9, 1.095}};
  EXPECT_TRUE(Envelope(ridge, 0.1).contains(above, kNone));
  const TrianglePoints higher{Vec3d{-0.02, 0.1, 1.09}, {0.02, 0.1, 1.09}, {0, 0.9, 1.105}};
  EXPECT_FALSE(Envelope(ridge, 0.1).contains(higher, kNone));
}

TEST(Envelope, AgreesWithDistancesOfManyPoints) {
  const Mesh ball = test::sphere(6);
  const NearestTriangles nearest(ball);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  int inside = 0;
  for (int i = 0; i < 400; ++i) {
    Vec3d center{any(random), any(random), any(random)};
    center *= (1 + 0.05 * any(random)) / length(center);
    TrianglePoints t;
    for (Vec3d& p : t) p = center + Vec3d{any(random), any(random), any(random)} * 0.3;
    double largest = 0;
    for (int u = 0; u <= 40; ++u)
      for (int v = 0; u + v <= 40; ++v)
        largest = std::max(largest,
                           nearest.find(t[0] + (t[1] - t[0]) * (u / 40.0) + (t[2] - t[0]) * (v / 40.0), kNone).squared);
    largest = std::sqrt(largest);
    // Between points of this grid there is a bit more.
    EXPECT_FALSE(Envelope(ball, largest * 0.999).contains(t, kNone)) << i;
    EXPECT_TRUE(Envelope(ball, largest + 0.012).contains(t, kNone)) << i;
    inside += largest < 0.2;
  }
  EXPECT_GT(inside, 40);
}

TEST(Envelope, NamesTheTrianglesThatAreNear) {
  const Mesh ridge = roof();
  std::vector<std::uint32_t> used;
  EXPECT_TRUE(
      Envelope(ridge, 0.01).contains({Vec3d{-0.5, 0.2, 0.5}, {-0.25, 0.1, 0.75}, {-0.3, 0.12, 0.7}}, kNone, &used));
  EXPECT_EQ(used, std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace pdc::detail
