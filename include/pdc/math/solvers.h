#pragma once

#include <array>
#include <optional>

#include "pdc/math/mat3.h"
#include "pdc/math/sym_mat3.h"

/// Solvers for symmetric 3×3 systems and for minimising quadrics f(x) = xᵀAx − 2bᵀx.
namespace pdc {

/// Solves Ax = b by an unrolled LDLᵀ factorisation without pivoting.
/// \returns nothing if A is not positive definite to working precision.
template <typename T>
constexpr std::optional<Vec3<T>> solveLdlt(const SymMat3<T>& A, const Vec3<T>& b) {
  const T d0 = A.xx;
  if (!(d0 > 0)) return std::nullopt;
  const T l10 = A.xy / d0, l20 = A.xz / d0;
  const T d1 = A.yy - l10 * A.xy;
  if (!(d1 > 0)) return std::nullopt;
  const T e = A.yz - l20 * A.xy;
  const T l21 = e / d1;
  const T d2 = A.zz - l20 * A.xz - l21 * e;
  if (!(d2 > 0)) return std::nullopt;
  const T y1 = b.y - l10 * b.x;
  const T y2 = b.z - l20 * b.x - l21 * y1;
  const T z = y2 / d2;
  const T y = y1 / d1 - l21 * z;
  return Vec3<T>{b.x / d0 - l10 * y - l20 * z, y, z};
}

/// Eigenvalues in descending order, with unit eigenvectors.
struct Eigen3 {
  std::array<double, 3> value;
  std::array<Vec3d, 3> vector;
};

/// Eigen-decomposition of a symmetric matrix by cyclic Jacobi rotations; accurate to a few ulp of the largest eigenvalue.
[[nodiscard]] Eigen3 eigenSymmetric(const SymMat3<double>& A);

/// A⁺b, leaving out eigenvalues at or below `relativeCutoff` times the largest: the shortest of the least-squares solutions
/// (Lindstrom 2000). Zero for A = 0. `rank`, if given, receives the number of eigenvalues used.
[[nodiscard]] Vec3d solvePseudoInverse(const SymMat3<double>& A, const Vec3d& b, double relativeCutoff, int* rank = nullptr);

/// The point of the cube [−halfSize, halfSize]³ that minimises f(x) = xᵀAx − 2bᵀx; exact, not a clamp of the free minimiser.
/// \param A positive definite.
/// \param free the unconstrained minimiser A⁻¹b.
[[nodiscard]] Vec3d minimizeInCube(const SymMat3<double>& A, const Vec3d& b, const Vec3d& free, double halfSize);

}  // namespace pdc
