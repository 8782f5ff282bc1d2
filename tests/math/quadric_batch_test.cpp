#include "pdc/math/quadric_batch.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "math/quadric_checks.h"
#include "math/random_geometry.h"
#include "pdc/math/solvers.h"
#include "pdc/math/triangle_quadric.h"
#include "simd_levels.h"

namespace pdc {
namespace {

constexpr std::size_t kBatches = 7;

template <typename T>
SymMat3<T> symCast(const SymMat3<double>& m) {
  return {static_cast<T>(m.xx), static_cast<T>(m.xy), static_cast<T>(m.xz),
          static_cast<T>(m.yy), static_cast<T>(m.yz), static_cast<T>(m.zz)};
}

/// Inputs of every kind, the same ones every time.
template <typename T>
struct Inputs {
  std::vector<PlaneLanes<T>> planes;
  std::vector<TriangleLanes<T>> triangles;
  std::vector<SymMat3Lanes<T>> Sigma_n, Sigma_q;
  std::vector<Vec3Lanes<T>> sigmas;
  std::vector<TriangleCovarianceLanes<T>> Sigmas;

  Inputs()
      : planes(kBatches),
        triangles(kBatches),
        Sigma_n(kBatches),
        Sigma_q(kBatches),
        sigmas(kBatches),
        Sigmas(kBatches) {
    RandomGeometry random(1);
    for (std::size_t i = 0; i < kBatches; ++i) {
      for (int lane = 0; lane < kLanes; ++lane) {
        for (auto* v : {&planes[i].q, &planes[i].n, &triangles[i].p, &triangles[i].q, &triangles[i].r, &sigmas[i]})
          v->set(lane, vecCast<T>(random.point()));
        for (auto* m : {&Sigma_n[i], &Sigma_q[i], &Sigmas[i].p, &Sigmas[i].q, &Sigmas[i].r})
          m->set(lane, symCast<T>(random.covariance(0.2)));
      }
    }
  }
};

template <typename T>
bool sameBits(const Quadric<T>& p, const Quadric<T>& q) {
  return std::memcmp(&p, &q, sizeof p) == 0;
}

/// Runs `function` with both kinds of output at every level and expects the bits of `one(batch, lane)`.
template <typename T, typename Function, typename One>
void expectSameAsOneByOne(const Function& function, const One& one) {
  for (const SimdLevel level : test::simdLevels()) {
    std::vector<QuadricLanes<T>> quadrics(kBatches);
    std::vector<NormalEquationsLanes<T>> equations(kBatches);
    function(std::span(quadrics), level);
    function(std::span(equations), level);
    for (std::size_t i = 0; i < kBatches; ++i) {
      for (int lane = 0; lane < kLanes; ++lane) {
        const Quadric<T> expected = one(i, lane);
        EXPECT_TRUE(sameBits(quadrics[i].get(lane), expected)) << static_cast<int>(level) << ' ' << i << ' ' << lane;
        const auto [A, b] = equations[i].get(lane);
        EXPECT_TRUE(sameBits({A, b, expected.c}, expected)) << static_cast<int>(level) << ' ' << i << ' ' << lane;
      }
    }
  }
}

template <typename T>
class QuadricBatch : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(QuadricBatch, Scalars);

TYPED_TEST(QuadricBatch, PlanesAreThoseOfOneByOne) {
  using T = TypeParam;
  const Inputs<T> in;
  const auto q = [&](std::size_t i, int lane) { return in.planes[i].q.get(lane); };
  const auto n = [&](std::size_t i, int lane) { return in.planes[i].n.get(lane); };
  expectSameAsOneByOne<T>([&](auto out, SimdLevel level) { planeQuadrics(in.planes, out, level); },
                          [&](std::size_t i, int lane) { return planeQuadric(q(i, lane), n(i, lane)); });
  expectSameAsOneByOne<T>(
      [&](auto out, SimdLevel level) { probabilisticPlaneQuadrics(in.planes, T(0.1), T(0.2), out, level); },
      [&](std::size_t i, int lane) { return probabilisticPlaneQuadric(q(i, lane), n(i, lane), T(0.1), T(0.2)); });
  expectSameAsOneByOne<T>(
      [&](auto out, SimdLevel level) { probabilisticPlaneQuadrics(in.planes, in.Sigma_n, out, level); },
      [&](std::size_t i, int lane) {
        return probabilisticPlaneQuadric(q(i, lane), n(i, lane), in.Sigma_n[i].get(lane));
      });
  for (const SimdLevel level : test::simdLevels()) {
    std::vector<QuadricLanes<T>> out(kBatches);
    probabilisticPlaneQuadrics<T>(in.planes, in.Sigma_n, in.Sigma_q, out, level);
    EXPECT_TRUE(sameBits(out[3].get(5),
                         probabilisticPlaneQuadric(q(3, 5), n(3, 5), in.Sigma_n[3].get(5), in.Sigma_q[3].get(5))));
  }
}

TYPED_TEST(QuadricBatch, TrianglesAreThoseOfOneByOne) {
  using T = TypeParam;
  const Inputs<T> in;
  const auto make = [&](std::size_t i, int lane, const auto&... sigma) {
    const auto& t = in.triangles[i];
    return probabilisticTriangleQuadric(t.p.get(lane), t.q.get(lane), t.r.get(lane), sigma...);
  };
  expectSameAsOneByOne<T>([&](auto out, SimdLevel level) { triangleQuadrics(in.triangles, out, level); },
                          [&](std::size_t i, int lane) {
                            const auto& t = in.triangles[i];
                            return triangleQuadric(t.p.get(lane), t.q.get(lane), t.r.get(lane));
                          });
  expectSameAsOneByOne<T>(
      [&](auto out, SimdLevel level) { probabilisticTriangleQuadrics(in.triangles, T(0.1), out, level); },
      [&](std::size_t i, int lane) { return make(i, lane, T(0.1)); });
  expectSameAsOneByOne<T>(
      [&](auto out, SimdLevel level) { probabilisticTriangleQuadrics(in.triangles, in.sigmas, out, level); },
      [&](std::size_t i, int lane) {
        const auto s = in.sigmas[i].get(lane);
        return make(i, lane, s.x, s.y, s.z);
      });
  expectSameAsOneByOne<T>(
      [&](auto out, SimdLevel level) { probabilisticTriangleQuadrics(in.triangles, in.Sigmas, out, level); },
      [&](std::size_t i, int lane) {
        const auto& s = in.Sigmas[i];
        return make(i, lane, s.p.get(lane), s.q.get(lane), s.r.get(lane));
      });
}

TYPED_TEST(QuadricBatch, SolutionsAreThoseOfOneByOne) {
  using T = TypeParam;
  const Inputs<T> in;
  std::vector<QuadricLanes<T>> systems(kBatches);
  probabilisticTriangleQuadrics(in.triangles, T(0.1), std::span(systems));
  systems[2].set(3, planeQuadric(Vec3<T>{1, 2, 3}, Vec3<T>{0, 0, 1}));
  systems[4].set(9, Quadric<T>::zero());
  for (const SimdLevel level : test::simdLevels()) {
    std::vector<SolutionLanes<T>> solutions(kBatches);
    solveLdlt<QuadricLanes<T>>(systems, solutions, level);
    for (std::size_t i = 0; i < kBatches; ++i) {
      for (int lane = 0; lane < kLanes; ++lane) {
        const auto expected = solveLdlt(systems[i].A.get(lane), systems[i].b.get(lane));
        EXPECT_EQ(solutions[i].solved[lane], expected.has_value());
        EXPECT_EQ(solutions[i].x.get(lane), expected.value_or(Vec3<T>{}));
      }
    }
    EXPECT_FALSE(solutions[2].solved[3]);
    EXPECT_FALSE(solutions[4].solved[9]);
  }
}

TYPED_TEST(QuadricBatch, SumsAreSums) {
  using T = TypeParam;
  const Inputs<T> in;
  std::vector<QuadricLanes<T>> quadrics(kBatches), doubled(kBatches);
  planeQuadrics(in.planes, std::span(quadrics));
  auto exact = Quadric<double>::zero();
  for (const auto& batch : quadrics) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const Quadric<T> f = batch.get(lane);
      exact += {{f.A.xx, f.A.xy, f.A.xz, f.A.yy, f.A.yz, f.A.zz}, vecCast<double>(f.b), f.c};
    }
  }
  const Quadric<T> sum = sumQuadrics<T>(quadrics);
  const Quadric<double> wide{
      {sum.A.xx, sum.A.xy, sum.A.xz, sum.A.yy, sum.A.yz, sum.A.zz}, vecCast<double>(sum.b), sum.c};
  EXPECT_LT(largestDifference(wide, exact), 4 * std::numeric_limits<T>::epsilon() * (exact.A.trace() + exact.c));

  doubled = quadrics;
  addQuadrics<QuadricLanes<T>>(quadrics, doubled);
  EXPECT_TRUE(sameBits(doubled[5].get(7), quadrics[5].get(7) + quadrics[5].get(7)));
  EXPECT_TRUE(sameBits(sumQuadrics<T>(doubled), sum * T(2)));
}

TYPED_TEST(QuadricBatch, SumsHaveTheSameBitsAtEveryLevel) {
  using T = TypeParam;
  const Inputs<T> in;
  std::vector<QuadricLanes<T>> quadrics(1000);
  for (std::size_t i = 0; i < quadrics.size(); ++i) {
    std::vector<PlaneLanes<T>> plane{in.planes[i % kBatches]};
    planeQuadrics(plane, std::span(&quadrics[i], 1));
  }
  const Quadric<T> sum = sumQuadrics<T>(quadrics, SimdLevel::kBaseline);
  for (const SimdLevel level : test::simdLevels()) EXPECT_TRUE(sameBits(sumQuadrics<T>(quadrics, level), sum));
}

// A running sum in single precision is a percent off.
TEST(SumQuadrics, LosesNothingInLongSums) {
  QuadricLanes<float> tenths;
  for (int lane = 0; lane < kLanes; ++lane) tenths.set(lane, pointQuadric(Vec3f{0.1F, 0, 0}));
  const std::vector<QuadricLanes<float>> batches(1'000'000 / kLanes, tenths);
  EXPECT_NEAR(sumQuadrics<float>(batches).b.x, 1e5, 0.1);
}

TEST(QuadricBatch, RejectsSpansOfDifferentLength) {
  const std::vector<PlaneLanes<float>> planes(3);
  const std::vector<TriangleLanes<float>> triangles(3);
  const std::vector<SymMat3Lanes<float>> Sigma2(2), Sigma3(3);
  const std::vector<Vec3Lanes<float>> sigmas(2);
  const std::vector<TriangleCovarianceLanes<float>> Sigmas(2);
  std::vector<QuadricLanes<float>> quadrics2(2), quadrics3(3);
  std::vector<SolutionLanes<float>> solutions(2);
  const std::span two(quadrics2), three(quadrics3);
  EXPECT_THROW(planeQuadrics(planes, two), std::invalid_argument);
  EXPECT_THROW(probabilisticPlaneQuadrics(planes, 0.1F, 0.1F, two), std::invalid_argument);
  EXPECT_THROW(probabilisticPlaneQuadrics(planes, Sigma3, two), std::invalid_argument);
  EXPECT_THROW(probabilisticPlaneQuadrics(planes, Sigma2, three), std::invalid_argument);
  EXPECT_THROW(probabilisticPlaneQuadrics<float>(planes, Sigma3, Sigma3, two), std::invalid_argument);
  EXPECT_THROW(probabilisticPlaneQuadrics<float>(planes, Sigma2, Sigma3, three), std::invalid_argument);
  EXPECT_THROW(probabilisticPlaneQuadrics<float>(planes, Sigma3, Sigma2, three), std::invalid_argument);
  EXPECT_THROW(triangleQuadrics(triangles, two), std::invalid_argument);
  EXPECT_THROW(probabilisticTriangleQuadrics(triangles, 0.1F, two), std::invalid_argument);
  EXPECT_THROW(probabilisticTriangleQuadrics(triangles, sigmas, three), std::invalid_argument);
  EXPECT_THROW(probabilisticTriangleQuadrics(triangles, Sigmas, three), std::invalid_argument);
  EXPECT_THROW(addQuadrics<QuadricLanes<float>>(two, three), std::invalid_argument);
  EXPECT_THROW(solveLdlt<QuadricLanes<float>>(three, solutions), std::invalid_argument);
}

TEST(QuadricLanes, HoldCountsInWholeBatches) {
  EXPECT_EQ(batchCount(0), 0U);
  EXPECT_EQ(batchCount(1), 1U);
  EXPECT_EQ(batchCount(16), 1U);
  EXPECT_EQ(batchCount(17), 2U);
}

}  // namespace
}  // namespace pdc
