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
              f -= probabilisticPlaneQuadric(q, n, tangentialCovariance(n, 0.1)) * 0.01;
              f += probabilisticTriangleQuadric(p, q, r, 0.1, 0.2, 0.3);
              f += triangleQuadric(p, q, r) + probabilisticTriangleQuadric(p, q, r, 0.1) * 2.0;
              f += probabilisticTriangleQuadric(p, q, r, S, S, S).relativeTo(p).pullback(Mat3d{}, q);
              f += sampleExpectedQuadric(10, [&] { return pointQuadric(random.point()); }).mean;
              x = solveLdlt(f.A, f.b).value() + minimizeNear(f, p, 1e-3);
              x += minimizeInBox(f.A, f.b, x, {{-1e-3, -1e-3, -1e-3}, {1e-3, 1e-3, 1e-3}});
              x += minimizeInCube(f.A, f.b, x, 1e-3) + f.halfGradient(x) * f(x);
              x += (f.normalEquations() + NormalEquations<double>::zero()).b + eigenSymmetric(f.A).vector[0];
              x *= solveQuality(f.A, 1e-3).condition + solutionCovariance(f.A, 1)->trace();
            }),
            0);
  EXPECT_NE(x, Vec3d{});
}

template <typename T>
void expectBatchesMakeNone() {
  const std::vector<PlaneLanes<T>> planes(100, PlaneLanes<T>{});
  const std::vector<TriangleLanes<T>> triangles(100, TriangleLanes<T>{});
  const std::vector<Vec3Lanes<T>> sigmas(100, Vec3Lanes<T>{});
  const std::vector<SymMat3Lanes<T>> Sigma(100, SymMat3Lanes<T>{});
  const std::vector<TriangleCovarianceLanes<T>> Sigmas(100, TriangleCovarianceLanes<T>{});
  std::vector<QuadricLanes<T>> quadrics(100);
  std::vector<SolutionLanes<T>> solutions(100);
  const std::span out(quadrics);
  EXPECT_EQ(allocationsOf([&] {
              planeQuadrics(planes, out);
              probabilisticPlaneQuadrics(planes, T(0.1), T(0.1), out);
              probabilisticPlaneQuadrics(planes, Sigma, out);
              probabilisticPlaneQuadrics<T>(planes, Sigma, Sigma, out);
              triangleQuadrics(triangles, out);
              probabilisticTriangleQuadrics(triangles, Sigmas, out);
              probabilisticTriangleQuadrics(triangles, sigmas, out);
              probabilisticTriangleQuadrics(triangles, T(0.1), out);
              addQuadrics<QuadricLanes<T>>(quadrics, out);
              solveLdlt<QuadricLanes<T>>(quadrics, solutions);
              quadrics[0].c[0] += sumQuadrics<T>(quadrics).c;
            }),
            0);
}

TEST(Allocations, BatchesMakeNone) {
  expectBatchesMakeNone<float>();
  expectBatchesMakeNone<double>();
}

}  // namespace
}  // namespace pdc
