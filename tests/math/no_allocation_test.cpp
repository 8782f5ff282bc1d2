// A program of its own, whose operator new counts: quadrics, their solvers and their batches must never ask for memory.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <span>
#include <vector>

#include "math/random_geometry.h"
#include "pdc/math/expected_quadric.h"
#include "pdc/math/quadric_batch.h"
#include "pdc/math/solve_quality.h"
#include "pdc/math/solvers.h"
#include "pdc/math/triangle_quadric.h"

namespace {

std::atomic<int> gAllocations{0};

void* allocate(std::size_t size, std::size_t alignment) {
  ++gAllocations;
  if (void* p = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)) return p;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace pdc {
namespace {

/// Allocations made by f().
template <typename F>
int allocationsOf(const F& f) {
  const int before = gAllocations;
  f();
  return gAllocations - before;
}

TEST(Allocations, AreCounted) {
  EXPECT_EQ(allocationsOf([] { std::vector<QuadricLanes<float>> v(3); }), 1);
}

TEST(Allocations, OneByOneMakesNone) {
  RandomGeometry random(1);
  const Vec3d p = random.point(), q = random.point(), r = random.point(), n = random.direction();
  const auto S = random.covariance(0.1);
  Vec3d x{};
  EXPECT_EQ(allocationsOf([&] {
              auto f = pointQuadric(p) + planeQuadric(p, n) + probabilisticPlaneQuadric(p, n, S, S);
              f += probabilisticPlaneQuadric(q, n, 0.1, 0.1) - planeQuadric(q, n);
              f += triangleQuadric(p, q, r) + probabilisticTriangleQuadric(p, q, r, 0.1) * 2.0;
              f += probabilisticTriangleQuadric(p, q, r, S, S, S).relativeTo(p).pullback(Mat3d{}, q);
              f += sampleExpectedQuadric(10, [&] { return pointQuadric(random.point()); }).mean;
              x = solveLdlt(f.A, f.b).value() + minimizeNear(f, p, 1e-3);
              x += minimizeInBox(f.A, f.b, x, {{-1e-3, -1e-3, -1e-3}, {1e-3, 1e-3, 1e-3}});
              x *= solveQuality(f.A, 1e-3).condition + solutionCovariance(f.A, 1)->trace();
            }),
            0);
  EXPECT_NE(x, Vec3d{});
}

TEST(Allocations, BatchesMakeNone) {
  const std::vector<PlaneLanes<float>> planes(100, PlaneLanes<float>{});
  const std::vector<TriangleLanes<float>> triangles(100, TriangleLanes<float>{});
  const std::vector<SymMat3Lanes<float>> Sigma(100, SymMat3Lanes<float>{});
  const std::vector<TriangleCovarianceLanes<float>> Sigmas(100, TriangleCovarianceLanes<float>{});
  std::vector<QuadricLanes<float>> quadrics(100);
  std::vector<SolutionLanes<float>> solutions(100);
  const std::span out(quadrics);
  EXPECT_EQ(allocationsOf([&] {
              planeQuadrics(planes, out);
              probabilisticPlaneQuadrics(planes, 0.1F, 0.1F, out);
              probabilisticPlaneQuadrics(planes, Sigma, out);
              triangleQuadrics(triangles, out);
              probabilisticTriangleQuadrics(triangles, Sigmas, out);
              probabilisticTriangleQuadrics(triangles, 0.1F, out);
              addQuadrics<QuadricLanes<float>>(quadrics, out);
              solveLdlt<QuadricLanes<float>>(quadrics, solutions);
              quadrics[0].c[0] += sumQuadrics<float>(quadrics).c;
            }),
            0);
}

}  // namespace
}  // namespace pdc
