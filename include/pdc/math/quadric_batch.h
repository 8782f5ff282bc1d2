#pragma once

#include <span>

#include "pdc/math/quadric_lanes.h"
#include "pdc/math/simd_level.h"

/// Many quadrics at once, on the calling thread: each function is the one-by-one function of the same name (quadric.h,
/// triangle_quadric.h, solvers.h) in every lane of every batch, by the widest vectors the processor has. Equations are
/// those of Trettner & Kobbelt 2020; units, ranges and what NaN does are as in the one-by-one functions.
///
/// `Out` is QuadricLanes<T>, or NormalEquationsLanes<T> where the constant is not wanted; T is float or double. All
/// spans of a call have one length, counted in batches; std::invalid_argument if not. Outputs must not overlap inputs.
/// The results have the bits of the one-by-one functions compiled without contraction, at every level. Nothing
/// allocates, and calls on different outputs may run at the same time. Memory soon sets the pace: feed chunks that stay
/// in cache (some hundred batches) and use the results up while they are there. The parameter `level` is for tests and
/// timings; a level above the processor's counts as its best.
namespace pdc {

/// Squared distances to planes (equation 4).
template <typename Out>
void planeQuadrics(std::span<const PlaneLanes<typename Out::Scalar>> planes, std::span<Out> out,
                   SimdLevel level = bestSimdLevel());

/// Isotropic noise with the same standard deviations for all planes (equations 6-8).
template <typename Out>
void probabilisticPlaneQuadrics(std::span<const PlaneLanes<typename Out::Scalar>> planes,
                                typename Out::Scalar sigmaNormal, typename Out::Scalar sigmaPosition,
                                std::span<Out> out, SimdLevel level = bestSimdLevel());

/// Noisy normals, each with its own covariance, and exact points (equations 6-8 with Σq = 0).
template <typename Out>
void probabilisticPlaneQuadrics(std::span<const PlaneLanes<typename Out::Scalar>> planes,
                                std::span<const SymMat3Lanes<typename Out::Scalar>> Sigma_n, std::span<Out> out,
                                SimdLevel level = bestSimdLevel());

/// Noisy normals and points, each with its own covariance (equations 6-8). Sigma_q enters the constant only.
template <typename T>
void probabilisticPlaneQuadrics(std::span<const PlaneLanes<T>> planes, std::span<const SymMat3Lanes<T>> Sigma_n,
                                std::span<const SymMat3Lanes<T>> Sigma_q, std::span<QuadricLanes<T>> out,
                                SimdLevel level = bestSimdLevel());

/// Squared distances to the planes of triangles, times (2 area)² (equation 9).
template <typename Out>
void triangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles, std::span<Out> out,
                      SimdLevel level = bestSimdLevel());

/// Isotropic noise with the same standard deviation for all corners of all triangles (equations 11-15).
template <typename Out>
void probabilisticTriangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles,
                                   typename Out::Scalar sigma, std::span<Out> out, SimdLevel level = bestSimdLevel());

/// Isotropic noise with a standard deviation for each corner (equations 11-15): those of (p, q, r) are the (x, y, z) of
/// `sigmas`.
template <typename Out>
void probabilisticTriangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles,
                                   std::span<const Vec3Lanes<typename Out::Scalar>> sigmas, std::span<Out> out,
                                   SimdLevel level = bestSimdLevel());

/// Noise with a covariance for each corner (equations 11-15).
template <typename Out>
void probabilisticTriangleQuadrics(std::span<const TriangleLanes<typename Out::Scalar>> triangles,
                                   std::span<const TriangleCovarianceLanes<typename Out::Scalar>> Sigmas,
                                   std::span<Out> out, SimdLevel level = bestSimdLevel());

/// Adds from[i] to to[i].
template <typename Lanes>
void addQuadrics(std::span<const Lanes> from, std::span<Lanes> to, SimdLevel level = bestSimdLevel());

/// The sum over all lanes of all batches, in pairs of halves, so that rounding grows with the logarithm of their
/// number; zero for none. The order depends on that number alone. Unused lanes must be zero.
template <typename T>
[[nodiscard]] Quadric<T> sumQuadrics(std::span<const QuadricLanes<T>> quadrics, SimdLevel level = bestSimdLevel());

/// The minimisers A⁻¹b, as solveLdlt() of solvers.h finds them; Lanes is NormalEquationsLanes<T> or QuadricLanes<T>.
template <typename Lanes>
void solveLdlt(std::span<const Lanes> systems, std::span<SolutionLanes<typename Lanes::Scalar>> solutions,
               SimdLevel level = bestSimdLevel());

}  // namespace pdc
