#pragma once

#include <array>
#include <limits>
#include <optional>

#include "pdc/math/box.h"
#include "pdc/math/mat3.h"
#include "pdc/math/quadric.h"
#include "pdc/math/sym_mat3.h"

/// Solvers for symmetric 3×3 systems and for minimising quadrics f(x) = xᵀAx − 2bᵀx. They are pure functions that
/// neither allocate nor throw, and they check nothing: unless said otherwise entries are finite, and NaN gives results
/// without meaning.
namespace pdc {

namespace detail {

/// \returns whether A is positive definite to working precision: a pivot at or below the rounding of its diagonal entry
/// counts as zero. \param[out] x the solution if so, anything if not. Free of branches, for the sake of batches.
template <typename T>
constexpr bool ldlt(const SymMat3<T>& A, const Vec3<T>& b, Vec3<T>& x) {
  // A pivot is a difference of entries and their products, each rounded: some three epsilons of the diagonal entry.
  constexpr T kRounding = 4 * std::numeric_limits<T>::epsilon(), kTiny = std::numeric_limits<T>::min();
  const T r0 = 1 / A.xx, l10 = A.xy * r0, l20 = A.xz * r0;
  const T d1 = A.yy - l10 * A.xy, e = A.yz - l20 * A.xy, r1 = 1 / d1, l21 = e * r1;
  const T d2 = A.zz - l20 * A.xz - l21 * e;
  const T y1 = b.y - l10 * b.x, y2 = b.z - l20 * b.x - l21 * y1;
  x.z = y2 / d2;
  x.y = y1 * r1 - l21 * x.z;
  x.x = b.x * r0 - l10 * x.y - l20 * x.z;
  return (A.xx > kTiny) & (d1 > kRounding * A.yy + kTiny) & (d2 > kRounding * A.zz + kTiny);
}

}  // namespace detail

/// Solves Ax = b by an unrolled LDLᵀ factorisation without pivoting. Uses no fused multiply-add, which only hardware
/// does fast and which the accuracy does not need. The relative error is about the condition of A times the rounding
/// error. \returns nothing if A is not positive definite to working precision, that is, if a pivot drowns in the
/// rounding of its diagonal entry or in underflow; nothing too if A holds NaN. NaN in b gives NaN.
template <typename T>
constexpr std::optional<Vec3<T>> solveLdlt(const SymMat3<T>& A, const Vec3<T>& b) {
  Vec3<T> x{};
  if (!detail::ldlt(A, b, x)) return std::nullopt;
  return x;
}

/// Eigenvalues in descending order, with eigenvectors of unit length, each to the value of its index.
struct Eigen3 {
  std::array<double, 3> value;
  std::array<Vec3d, 3> vector;
};

/// Eigen-decomposition of a symmetric matrix by cyclic Jacobi rotations; accurate to a few ulp of the largest
/// eigenvalue.
[[nodiscard]] Eigen3 eigenSymmetric(const SymMat3<double>& A);

/// A⁺b without the eigenvalues at or below `relativeCutoff` (0 to 1) times the largest, nor those that are not
/// positive: the shortest of the least-squares solutions (Lindstrom 2000). Zero for A = 0. \param[out] rank if given,
/// the number of eigenvalues used, 0 to 3.
[[nodiscard]] Vec3d solvePseudoInverse(const SymMat3<double>& A, const Vec3d& b, double relativeCutoff,
                                       int* rank = nullptr);

/// The minimiser of f that is nearest to `reference`, with small eigenvalues cut off and `rank` given as
/// solvePseudoInverse() does: the way to minimise classical quadrics, whose minimum is a line or a plane more often
/// than a point.
[[nodiscard]] Vec3d minimizeNear(const Quadric<double>& f, const Vec3d& reference, double relativeCutoff,
                                 int* rank = nullptr);

/// The point of `box` that minimises f(x) = xᵀAx − 2bᵀx, exact up to rounding, where clamping the unconstrained
/// minimiser would give another point. Where that minimiser lies in the box it is returned as it is. \param A positive
/// definite. \param free the unconstrained minimiser A⁻¹b.
[[nodiscard]] Vec3d minimizeInBox(const SymMat3<double>& A, const Vec3d& b, const Vec3d& free, const Box& box);

/// minimizeInBox() for the cube [−halfSize, halfSize]³, halfSize >= 0.
[[nodiscard]] Vec3d minimizeInCube(const SymMat3<double>& A, const Vec3d& b, const Vec3d& free, double halfSize);

}  // namespace pdc
