#include "pdc/math/quadric_batch.h"

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <type_traits>

#include "math/lane_loops.h"
#include "pdc/math/solvers.h"
#include "pdc/math/triangle_quadric.h"

namespace pdc {
namespace {

void expectLength(std::size_t length, std::size_t expected) {
  if (length != expected) throw std::invalid_argument("pdc: the spans of a batch differ in length");
}

/// out[i] = make(i, lane), in all lanes of all batches.
template <typename Out, typename F>
void build(SimdLevel level, std::span<Out> out, const F& make) {
  detail::forEachBatch(level, out.size(), [out, &make](std::size_t i) {
    Out& batch = out[i];
    detail::forEachLane([&](int lane) { batch.set(lane, make(i, lane)); });
  });
}

/// How far ahead solving asks for memory, by measurement. A million systems are solved, relative to one by one in the
/// same run, in double precision 0.7 to 1.1 times as fast without, 1.7 with 2.5 KB, 1.5 with 5 KB, 1.3 with 10 KB; in
/// single precision 3.3, 3.3 with 2.5 KB and 3.7 with 5 KB. In cache it makes no difference.
constexpr std::size_t kPrefetchBytes = 5120;

/// Asks for the memory of the batch that is kPrefetchBytes ahead.
template <typename Lanes>
void prefetchAhead(std::span<const Lanes> batches, std::size_t i) {
  constexpr std::size_t kAhead = kPrefetchBytes / sizeof(Lanes), kCacheLine = 64;
  if (i + kAhead >= batches.size()) return;
  const auto* const batch = reinterpret_cast<const char*>(&batches[i + kAhead]);
  for (std::size_t k = 0; k < sizeof(Lanes); k += kCacheLine) __builtin_prefetch(batch + k);
}

/// An unsigned number as wide as the scalar T.
template <typename T>
using Bits = std::conditional_t<sizeof(T) == sizeof(std::uint32_t), std::uint32_t, std::uint64_t>;
/// The scalar whose bits are all set, which serves as a mask.
template <typename T>
constexpr T kAllBits = std::bit_cast<T>(~Bits<T>(0));

/// This many batches are summed one after the other; the rounding of so few is small beside that of the quadrics.
constexpr std::size_t kSumRun = 64;

/// Adds the batches to `sum`, lane by lane.
template <typename T>
void sumBatches(SimdLevel level, std::span<const QuadricLanes<T>> quadrics, QuadricLanes<T>& sum) {
  if (quadrics.size() > kSumRun) {
    const std::size_t half = quadrics.size() / 2;
    QuadricLanes<T> second{};
    sumBatches(level, quadrics.first(half), sum);
    sumBatches(level, quadrics.subspan(half), second);
    addQuadrics(std::span<const QuadricLanes<T>>(&second, 1), std::span<QuadricLanes<T>>(&sum, 1), level);
    return;
  }
  detail::forEachBatch(level, quadrics.size(), [quadrics, &sum](std::size_t i) {
    const QuadricLanes<T>& batch = quadrics[i];
    detail::forEachLane([&](int lane) { sum.set(lane, sum.get(lane) + batch.get(lane)); });
  });
}

}  // namespace

template <typename Out>
void planeQuadrics(std::span<const PlaneLanes<typename Out::Scalar>> planes, std::span<Out> out, SimdLevel level) {
  expectLength(planes.size(), out.size());
  build(level, out,
        [planes](std::size_t i, int lane) { return planeQuadric(planes[i].q.get(lane), planes[i].n.get(lane)); });
}

template <typename Out>
void probabilisticPlaneQuadrics(std::span<const PlaneLanes<typename Out::Scalar>> planes,
                                typename Out::Scalar sigmaNormal, typename Out::Scalar sigmaPosition,
                                std::span<Out> out, SimdLevel level) {
  expectLength(planes.size(), out.size());
  build(level, out, [=](std::size_t i, int lane) {
    return probabilisticPlaneQuadric(planes[i].q.get(lane), planes[i].n.get(lane), sigmaNormal, sigmaPosition);
  });
}

template <typename Out>
void probabilisticPlaneQuadrics(std::span<const PlaneLanes<typename Out::Scalar>> planes,
                                std::span<const SymMat3Lanes<typename Out::Scalar>> Sigma_n, std::span<Out> out,
                                SimdLevel level) {
  expectLength(planes.size(), out.size());
  expectLength(Sigma_n.size(), out.size());
  build(level, out, [=](std::size_t i, int lane) {
    return probabilisticPlaneQuadric(planes[i].q.get(lane), planes[i].n.get(lane), Sigma_n[i].get(lane));
  });
}

template <typename T>
void probabilisticPlaneQuadrics(std::span<const PlaneLanes<T>> planes, std::span<const SymMat3Lanes<T>> Sigma_n,
                                std::span<const SymMat3Lanes<T>> Sigma_q, std::span<QuadricLanes<T>> out,
                                SimdLevel level) {
  expectLength(planes.size(), out.size());
  expectLength(Sigma_n.size(), out.size());
  expectLength(Sigma_q.size(), out.size());
  build(level, out, [=](std::size_t i, int lane) {
    return probabilisticPlaneQuadric(planes[i].q.get(lane), planes[i].n.get(lane), Sigma_n[i].get(lane),
                                     Sigma_q[i].get(lane));
  });
}

template <typename Out>
void triangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles, std::span<Out> out,
                      SimdLevel level) {
  expectLength(triangles.size(), out.size());
  build(level, out, [triangles](std::size_t i, int lane) {
    const auto& t = triangles[i];
    return triangleQuadric(t.p.get(lane), t.q.get(lane), t.r.get(lane));
  });
}

template <typename Out>
void probabilisticTriangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles,
                                   typename Out::Scalar sigma, std::span<Out> out, SimdLevel level) {
  expectLength(triangles.size(), out.size());
  build(level, out, [=](std::size_t i, int lane) {
    const auto& t = triangles[i];
    return probabilisticTriangleQuadric(t.p.get(lane), t.q.get(lane), t.r.get(lane), sigma);
  });
}

template <typename Out>
void probabilisticTriangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles,
                                   std::span<const Vec3Lanes<typename Out::Scalar>> sigmas, std::span<Out> out,
                                   SimdLevel level) {
  expectLength(triangles.size(), out.size());
  expectLength(sigmas.size(), out.size());
  build(level, out, [=](std::size_t i, int lane) {
    const auto& t = triangles[i];
    const auto s = sigmas[i].get(lane);
    return probabilisticTriangleQuadric(t.p.get(lane), t.q.get(lane), t.r.get(lane), s.x, s.y, s.z);
  });
}

template <typename Out>
void probabilisticTriangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles,
                                   std::span<const TriangleCovarianceLanes<typename Out::Scalar>> Sigmas,
                                   std::span<Out> out, SimdLevel level) {
  expectLength(triangles.size(), out.size());
  expectLength(Sigmas.size(), out.size());
  build(level, out, [=](std::size_t i, int lane) {
    const auto& t = triangles[i];
    const auto& s = Sigmas[i];
    return probabilisticTriangleQuadric(t.p.get(lane), t.q.get(lane), t.r.get(lane), s.p.get(lane), s.q.get(lane),
                                        s.r.get(lane));
  });
}

template <typename Lanes>
void addQuadrics(std::span<const Lanes> from, std::span<Lanes> to, SimdLevel level) {
  expectLength(from.size(), to.size());
  build(level, to, [=](std::size_t i, int lane) { return to[i].get(lane) + from[i].get(lane); });
}

template <typename T>
Quadric<T> sumQuadrics(std::span<const QuadricLanes<T>> quadrics, SimdLevel level) {
  QuadricLanes<T> sum{};
  sumBatches(level, quadrics, sum);
  for (int width = kLanes / 2; width > 0; width /= 2)
    for (int lane = 0; lane < width; ++lane) sum.set(lane, sum.get(lane) + sum.get(lane + width));
  return sum.get(0);
}

template <typename Lanes>
void solveLdlt(std::span<const Lanes> systems, std::span<SolutionLanes<typename Lanes::Scalar>> solutions,
               SimdLevel level) {
  using T = typename Lanes::Scalar;
  expectLength(systems.size(), solutions.size());
  detail::forEachBatch(level, systems.size(), [=](std::size_t i) {
    const Lanes& batch = systems[i];
    SolutionLanes<T>& solution = solutions[i];
    prefetchAhead(systems, i);
    // Each loop has scalars of one size and no choice, because compilers would put selections into branches and would
    // not vectorise over bytes. The masks are floating-point numbers because SSE2 compares no others of eight bytes.
    alignas(64) T mask[kLanes];
    detail::forEachLane([&](int lane) {
      Vec3<T> x;
      mask[lane] = detail::ldlt(batch.A.get(lane), batch.b.get(lane), x) ? kAllBits<T> : T(0);
      solution.x.set(lane, x);
    });
    detail::forEachLane([&](int lane) {
      const auto keep = [bits = std::bit_cast<Bits<T>>(mask[lane])](T v) {
        return std::bit_cast<T>(std::bit_cast<Bits<T>>(v) & bits);
      };
      const Vec3<T> x = solution.x.get(lane);
      solution.x.set(lane, {keep(x.x), keep(x.y), keep(x.z)});
    });
    detail::forEachLane(
        [&](int lane) { solution.solved[lane] = static_cast<std::uint8_t>(std::bit_cast<Bits<T>>(mask[lane]) & 1); });
  });
}

// NOLINTBEGIN(bugprone-macro-parentheses): the arguments are types.

// All functions for one scalar and one kind of output.
#define PDC_INSTANTIATE_FOR_OUT(T, Out)                                                                              \
  template void planeQuadrics(std::span<const PlaneLanes<T>>, std::span<Out<T>>, SimdLevel);                         \
  template void probabilisticPlaneQuadrics(std::span<const PlaneLanes<T>>, T, T, std::span<Out<T>>, SimdLevel);      \
  template void probabilisticPlaneQuadrics(std::span<const PlaneLanes<T>>, std::span<const SymMat3Lanes<T>>,         \
                                           std::span<Out<T>>, SimdLevel);                                            \
  template void triangleQuadrics(std::span<const TriangleLanes<T>>, std::span<Out<T>>, SimdLevel);                   \
  template void probabilisticTriangleQuadrics(std::span<const TriangleLanes<T>>, T, std::span<Out<T>>, SimdLevel);   \
  template void probabilisticTriangleQuadrics(std::span<const TriangleLanes<T>>, std::span<const Vec3Lanes<T>>,      \
                                              std::span<Out<T>>, SimdLevel);                                         \
  template void probabilisticTriangleQuadrics(                                                                       \
      std::span<const TriangleLanes<T>>, std::span<const TriangleCovarianceLanes<T>>, std::span<Out<T>>, SimdLevel); \
  template void addQuadrics(std::span<const Out<T>>, std::span<Out<T>>, SimdLevel);                                  \
  template void solveLdlt(std::span<const Out<T>>, std::span<SolutionLanes<T>>, SimdLevel);

#define PDC_INSTANTIATE(T)                                                                                           \
  PDC_INSTANTIATE_FOR_OUT(T, QuadricLanes)                                                                           \
  PDC_INSTANTIATE_FOR_OUT(T, NormalEquationsLanes)                                                                   \
  template void probabilisticPlaneQuadrics(std::span<const PlaneLanes<T>>, std::span<const SymMat3Lanes<T>>,         \
                                           std::span<const SymMat3Lanes<T>>, std::span<QuadricLanes<T>>, SimdLevel); \
  template Quadric<T> sumQuadrics(std::span<const QuadricLanes<T>>, SimdLevel);

PDC_INSTANTIATE(float)
PDC_INSTANTIATE(double)

// NOLINTEND(bugprone-macro-parentheses)

}  // namespace pdc
