#pragma once

#include <span>

#include "pdc/math/quadric_lanes.h"
#include "pdc/math/simd_level.h"

/// Many quadrics at once, on one thread: each function is the one-by-one function of the same name (quadric.h,
/// triangle_quadric.h, solvers.h) in every lane of every block, by the widest vectors the processor has.
///
/// `Out` is QuadricLanes<T>, or NormalEquationsLanes<T> where the constant is not wanted; T is float or double. All
/// spans of a call have one length; std::invalid_argument if not. The results have the bits of the one-by-one functions
/// compiled without contraction, at every level. Nothing allocates. Memory soon sets the pace: feed chunks that stay in
/// cache (some hundred blocks) and use the results up while they are there. The parameter `level` is for tests and
/// timings; levels above the processor's count as its best.
namespace pdc {

/// Equation 4.
template <typename Out>
void planeQuadrics(std::span<const PlaneLanes<typename Out::Scalar>> planes, std::span<Out> out,
                   SimdLevel level = bestSimdLevel());

/// Equations 6-8, isotropic, with the same standard deviations for all.
template <typename Out>
void probabilisticPlaneQuadrics(std::span<const PlaneLanes<typename Out::Scalar>> planes,
                                typename Out::Scalar sigmaNormal, typename Out::Scalar sigmaPosition,
                                std::span<Out> out, SimdLevel level = bestSimdLevel());

/// Equations 6-8 with Σq = 0.
template <typename Out>
void probabilisticPlaneQuadrics(std::span<const PlaneLanes<typename Out::Scalar>> planes,
                                std::span<const SymMat3Lanes<typename Out::Scalar>> Sigma_n, std::span<Out> out,
                                SimdLevel level = bestSimdLevel());

/// Equations 6-8. Sigma_q enters the constant only.
template <typename T>
void probabilisticPlaneQuadrics(std::span<const PlaneLanes<T>> planes, std::span<const SymMat3Lanes<T>> Sigma_n,
                                std::span<const SymMat3Lanes<T>> Sigma_q, std::span<QuadricLanes<T>> out,
                                SimdLevel level = bestSimdLevel());

/// Equation 9.
template <typename Out>
void triangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles, std::span<Out> out,
                      SimdLevel level = bestSimdLevel());

/// Equations 11-15, isotropic, with the same standard deviation for all corners of all triangles.
template <typename Out>
void probabilisticTriangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles,
                                   typename Out::Scalar sigma, std::span<Out> out, SimdLevel level = bestSimdLevel());

/// Equations 11-15, isotropic, with a standard deviation for each corner: those of (p, q, r) are the (x, y, z) of
/// `sigmas`.
template <typename Out>
void probabilisticTriangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles,
                                   std::span<const Vec3Lanes<typename Out::Scalar>> sigmas, std::span<Out> out,
                                   SimdLevel level = bestSimdLevel());

/// Equations 11-15.
template <typename Out>
void probabilisticTriangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles,
                                   std::span<const TriangleCovarianceLanes<typename Out::Scalar>> Sigmas,
                                   std::span<Out> out, SimdLevel level = bestSimdLevel());

/// to += from.
template <typename Lanes>
void addQuadrics(std::span<const Lanes> from, std::span<Lanes> to, SimdLevel level = bestSimdLevel());

/// The sum over all lanes of all blocks, in pairs of halves: its rounding grows with the logarithm of their number. The
/// order depends on that number alone. Lanes in no use must be zero.
template <typename T>
[[nodiscard]] Quadric<T> sumQuadrics(std::span<const QuadricLanes<T>> quadrics, SimdLevel level = bestSimdLevel());

/// The minimisers A⁻¹b, as solveLdlt; Lanes is NormalEquationsLanes<T> or QuadricLanes<T>.
template <typename Lanes>
void solveLdlt(std::span<const Lanes> systems, std::span<SolutionLanes<typename Lanes::Scalar>> solutions,
               SimdLevel level = bestSimdLevel());

}  // namespace pdc
