#include "sample/stencils/gradient_stencil.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>

#include "simd_levels.h"

namespace pdc {
namespace {

using detail::GradientStencil;
using detail::SlopeLimits;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr SlopeLimits kNoLimits{-kInfinity, kInfinity};

BlockSigns signsOf(const GradientStencil& stencil) {
  BlockSigns signs;
  for (int x = 0; x < kBlockPoints; ++x)
    for (int y = 0; y < kBlockPoints; ++y)
      for (int z = 0; z < kBlockPoints; ++z)
        if (stencil.value[GradientStencil::index(x, y, z)] < 0)
          signs.row[kBlockPoints * x + y] = static_cast<std::uint16_t>(signs.row[kBlockPoints * x + y] | 1u << z);
  return signs;
}

template <typename F>
GradientStencil sample(const F& f) {
  GradientStencil stencil;
  for (int x = -1; x < GradientStencil::kPoints - 1; ++x)
    for (int y = -1; y < GradientStencil::kPoints - 1; ++y)
      for (int z = -1; z < GradientStencil::kPoints - 1; ++z)
        stencil.value[GradientStencil::index(x, y, z)] = f(x, y, z);
  return stencil;
}

/// Which rows of a stencil a block's crossings need, looked up point by point.
struct NeededRows {
  explicit NeededRows(const EdgeIndex& edges) {
    edges.forEach([&](int, int axis, int x, int y, int z) {
      for (int end = 0; end < 2; ++end) {
        Coord p{x, y, z};
        p[axis] += end;
        add(p);
        for (int other = 0; other < 3; ++other)
          for (const int step : {-1, 1}) {
            Coord neighbour = p;
            neighbour[other] += step;
            if (other != axis) add(neighbour);
          }
      }
    });
  }
  void add(const Coord& p) {
    rows.insert(static_cast<std::uint8_t>(GradientStencil::kPoints * (p[0] + 1) + p[1] + 1));
    parts |= 1u << (3 * GradientStencil::part(p[0]) + GradientStencil::part(p[1]));
    below = below || p[2] < 0;
  }
  std::set<std::uint8_t> rows;
  unsigned parts = 0;
  bool below = false;
};

TEST(GradientStencilRows, AreThoseOfTheCrossingsAndTheirNeighbours) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> place(-2, 11);
  int below = 0, notBelow = 0;
  for (int round = 0; round < 500; ++round) {
    // A small ball crosses few edges, anywhere in the block; every tenth stencil is random.
    const Vec3d center{place(engine), place(engine), place(engine)};
    const GradientStencil stencil = sample([&](int x, int y, int z) {
      if (round % 10 == 0) return engine() % 40 == 0 ? -1.0F : 1.0F;
      return static_cast<float>(length(Vec3d{double(x), double(y), double(z)} - center) - 1.3);
    });
    const EdgeIndex edges(signsOf(stencil));
    const detail::GradientStencilRows rows(edges);
    const NeededRows expected(edges);
    ASSERT_EQ(std::set<std::uint8_t>(rows.rows().begin(), rows.rows().end()), expected.rows) << round;
    ASSERT_EQ(rows.rows().size(), expected.rows.size()) << round;
    ASSERT_EQ(rows.parts(), expected.parts) << round;
    ASSERT_EQ(rows.below(), expected.below) << round;
    below += expected.below;
    notBelow += !expected.below && edges.size() > 0;
  }
  EXPECT_GT(below, 20);
  EXPECT_GT(notBelow, 100);
}

TEST(FillFromStencil, FindsThePlaneOfALinearFunction) {
  const Vec3d n = Vec3d{2, -3, 6} * (1.0 / 7);
  const auto f = [&](int x, int y, int z) {
    return static_cast<float>(dot(n, Vec3d{double(x), double(y), double(z)}) - 2.1);
  };
  const GradientStencil stencil = sample(f);
  const EdgeIndex edges(signsOf(stencil));
  ASSERT_GT(edges.size(), 50);
  HermiteBlock hermite;
  fillFromStencil(stencil, edges, kNoLimits, Mat3f::identity(), hermite);
  edges.forEach([&](int i, int axis, int x, int y, int z) {
    Vec3d p{double(x), double(y), double(z)};
    p[axis] += hermite.t[i];
    EXPECT_NEAR(dot(n, p), 2.1, 1e-6);
    EXPECT_LT(length(Vec3d{hermite.nx[i], hermite.ny[i], hermite.nz[i]} - n), 1e-6);
  });
}

// Values of a hundred orders of magnitude, clamped, infinite and undefined ones beside each other.
TEST(FillFromStencil, GivesUnitNormalsOrNoneAndTheSameBitsWithEveryInstructionSet) {
  std::mt19937 engine(3);
  std::uniform_int_distribution<int> kind(0, 19);
  std::normal_distribution<float> value;
  std::uniform_real_distribution<float> exponent(-40, 38);
  for (int round = 0; round < 50; ++round) {
    const GradientStencil stencil = sample([&](int, int, int) {
      switch (kind(engine)) {
        case 0:
          return kInfinity;
        case 1:
          return std::numeric_limits<float>::quiet_NaN();
        case 2:
          return std::pow(10.0F, exponent(engine));
        case 3:
          return -3.0F;
        default:
          return value(engine);
      }
    });
    const EdgeIndex edges(signsOf(stencil));
    const SlopeLimits limits = round % 2 == 0 ? kNoLimits : SlopeLimits{-2.9F, 2.9F};
    const Mat3f map = Mat3f::diagonal(1, -2, 0.5F);
    HermiteBlock plain, other;
    fillFromStencil(stencil, edges, limits, map, plain, SimdLevel::kBaseline);
    for (int i = 0; i < edges.size(); ++i) {
      ASSERT_TRUE(plain.t[i] >= 0 && plain.t[i] <= 1);
      const float l = length(Vec3f{plain.nx[i], plain.ny[i], plain.nz[i]});
      ASSERT_TRUE(l == 0 || std::abs(l - 1) < 1e-6F) << l;
    }
    for (const SimdLevel level : test::wideSimdLevels()) {
      fillFromStencil(stencil, edges, limits, map, other, level);
      const auto same = [&](const auto& a, const auto& b) {
        return std::memcmp(a.data(), b.data(), sizeof(float) * static_cast<std::size_t>(edges.size())) == 0;
      };
      EXPECT_TRUE(same(plain.t, other.t) && same(plain.nx, other.nx) && same(plain.ny, other.ny) &&
                  same(plain.nz, other.nz));
    }
  }
}

}  // namespace
}  // namespace pdc
