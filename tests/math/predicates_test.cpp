#include "pdc/math/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>

#include "math/whole_number.h"

namespace pdc {
namespace {

using Points = std::array<Vec3d, 4>;

Integer turn(const Vec3d& a, const Vec3d& b, const Vec3d& c, int axis) {
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  return (whole(b[x]) - whole(a[x])) * (whole(c[y]) - whole(a[y])) -
         (whole(b[y]) - whole(a[y])) * (whole(c[x]) - whole(a[x]));
}

int slowOrient3d(const Points& p) {
  Integer det = 0;
  for (int axis = 0; axis < 3; ++axis) det += turn(p[0], p[1], p[2], axis) * (whole(p[3][axis]) - whole(p[0][axis]));
  return signOf(det);
}

int slowOrient2d(const Points& p, int axis) { return signOf(turn(p[0], p[1], p[2], axis)); }

int fastOrient3d(const Points& p) { return orient3d(p[0], p[1], p[2], p[3]); }
int exactOrient3d(const Points& p) { return detail::orient3dExactly(p[0], p[1], p[2], p[3]); }

void expectExact(const Points& p) {
  const int sign = slowOrient3d(p);
  ASSERT_EQ(fastOrient3d(p), sign);
  ASSERT_EQ(exactOrient3d(p), sign);
  for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(orient2d(p[0], p[1], p[2], axis), slowOrient2d(p, axis));
}

double moved(double x, int ulps) {
  const double towards = ulps > 0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::abs(ulps); ++i) x = std::nextafter(x, towards);
  return x;
}

float movedFloat(float x, int ulps) {
  const float towards = ulps > 0 ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
  for (int i = 0; i < std::abs(ulps); ++i) x = std::nextafter(x, towards);
  return x;
}

TEST(Predicates, SidesAreCounterClockwiseSeenFromOutside) {
  EXPECT_EQ(orient3d(Vec3d{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orient3d(Vec3f{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}), -1);
  EXPECT_EQ(orient3d(Vec3f{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 7, 0}), 0);
  EXPECT_EQ(orient2d(Vec3d{0, 0, 9}, {1, 0, 3}, {0, 1, 5}, 2), 1);
  EXPECT_EQ(orient2d(Vec3f{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0), 1);
  EXPECT_EQ(orient2d(Vec3f{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1), 1);
  EXPECT_EQ(orient2d(Vec3f{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 1), -1);
}

TEST(Predicates, ExactOnSmallIntegerGrids) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> coordinate(-2, 2);
  std::array<int, 3> seen{};
  for (int round = 0; round < 20000; ++round) {
    Points p{};
    for (Vec3d& v : p) v = Vec3d{1.0 * coordinate(random), 1.0 * coordinate(random), 1.0 * coordinate(random)};
    expectExact(p);
    ++seen[static_cast<std::size_t>(1 + fastOrient3d(p))];
  }
  for (const int count : seen) EXPECT_GT(count, 1000);
}

TEST(Predicates, ExactOverTheWholeRange) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> exponent(-247, 299);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  const auto coordinate = [&] {
    const double x = std::ldexp(mantissa(random), exponent(random));
    return std::abs(x) < 0x1p-247 ? 0.0 : x;  // its last bit is at least 2^-300
  };
  for (int round = 0; round < 5000; ++round) {
    Points p{};
    for (Vec3d& v : p) v = {coordinate(), coordinate(), coordinate()};
    expectExact(p);
  }
}

TEST(Predicates, ExactNextToAPlaneInDoublePrecision) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::uniform_int_distribution<int> ulps(-2, 2);
  std::array<int, 3> seen{};
  for (int round = 0; round < 20000; ++round) {
    const auto point = [&] { return Vec3d{uniform(random), uniform(random), uniform(random)}; };
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 40) - 20);
    Points p{point() * scale, point(), point() * scale, {}};
    const Vec3d on = p[0] + (p[1] - p[0]) * uniform(random) + (p[2] - p[0]) * uniform(random);
    p[3] = {moved(on.x, ulps(random)), moved(on.y, ulps(random)), moved(on.z, ulps(random))};
    expectExact(p);
    ++seen[static_cast<std::size_t>(1 + fastOrient3d(p))];
  }
  EXPECT_GT(std::min(seen[0], seen[2]), 1000);
}

TEST(Predicates, ExactNextToAPlaneInSinglePrecision) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> whole(-40, 40), ulps(-1, 1);
  std::array<int, 3> seen{};
  for (int round = 0; round < 20000; ++round) {
    const auto vector = [&] { return Vec3d{1.0 * whole(random), 1.0 * whole(random), 1.0 * whole(random)}; };
    // A lattice far from the origin: its points are exact, those next to it one rounding away.
    const Vec3d origin = vector() * 1024.0, u = vector(), v = vector();
    Points p{};
    std::array<Vec3f, 4> f{};
    for (std::size_t i = 0; i < 4; ++i) {
      f[i] = vecCast<float>((origin + u * whole(random) + v * whole(random)) * 0x1p-10);
      if (i == 3) f[i].z = movedFloat(f[i].z, ulps(random));
      p[i] = vecCast<double>(f[i]);
    }
    expectExact(p);
    ASSERT_EQ(orient3d(f[0], f[1], f[2], f[3]), fastOrient3d(p));
    ++seen[static_cast<std::size_t>(1 + fastOrient3d(p))];
  }
  for (const int count : seen) EXPECT_GT(count, 1000);
}

TEST(Predicates, ExactForTheExtremesOfSinglePrecision) {
  using Limits = std::numeric_limits<float>;
  constexpr std::array<float, 9> kValues = {-Limits::max(),       -1, -Limits::min(),        -Limits::denorm_min(), 0,
                                            Limits::denorm_min(), 1,  1 + Limits::epsilon(), Limits::max()};
  std::mt19937 random(5);
  for (int round = 0; round < 20000; ++round) {
    Points p{};
    for (Vec3d& v : p)
      for (int axis = 0; axis < 3; ++axis) v[axis] = static_cast<double>(kValues[random() % kValues.size()]);
    expectExact(p);
  }
}

TEST(Predicates, SignFollowsTheParityOfTheOrder) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> uniform(0.25f, 0.5f);
  for (int round = 0; round < 300; ++round) {
    // Nearly flat, so that many orders need exact arithmetic.
    Points p{};
    for (Vec3d& v : p) {
      const float x = uniform(random), y = uniform(random);
      v = vecCast<double>(Vec3f{x, y, x + y});
    }
    std::array<std::size_t, 4> order{};
    std::iota(order.begin(), order.end(), 0);
    const int sign = fastOrient3d(p);
    do {
      int inversions = 0;
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < i; ++j) inversions += order[j] > order[i];
      const Points q{p[order[0]], p[order[1]], p[order[2]], p[order[3]]};
      ASSERT_EQ(fastOrient3d(q), inversions % 2 == 0 ? sign : -sign);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(Predicates, Collinear) {
  const Vec3f a{0.1f, 0.2f, 0.3f};
  EXPECT_TRUE(collinear(a, a, Vec3f{1, 2, 3}));
  EXPECT_TRUE(collinear(Vec3f{1, 2, 3}, a, a));
  EXPECT_TRUE(collinear(a, a * 2.0f, a * 4.0f));
  EXPECT_FALSE(collinear(a, a * 2.0f, Vec3f{a.x * 4, a.y * 4, std::nextafter(a.z * 4, 9.0f)}));
  EXPECT_FALSE(collinear(Vec3d{0, 0, 0}, {1, 0, 0}, {2, 0, 1e-30}));
}

}  // namespace
}  // namespace pdc
