#pragma once

#include <optional>

#include "pdc/math/sym_mat3.h"

/// How far the solution of Ax = b can be trusted. Pure functions, which neither allocate nor throw.
namespace pdc {

/// Measures of a symmetric matrix.
struct SolveQuality {
  double condition;  ///< Largest over smallest eigenvalue, >= 1; infinite if the smallest is not positive.
  int rank;          ///< Number of positive eigenvalues above the cut-off, 0 to 3.
};

/// \param A positive semidefinite up to rounding, entries finite.
/// \param relativeCutoff eigenvalues at or below this share of the largest count as zero, as in solvePseudoInverse(); 0
/// to 1.
[[nodiscard]] SolveQuality solveQuality(const SymMat3<double>& A, double relativeCutoff);

/// Covariance of the minimiser of a sum of squared residuals (nᵢᵀx − dᵢ)², A = Σ nᵢnᵢᵀ, whose dᵢ are independent with
/// one variance, residualVariance >= 0: it is residualVariance A⁻¹ (Gauss-Markov). An unbiased estimate of that
/// variance from m residuals is f(x_min) / (m − 3). \returns nothing if A is not positive definite to working
/// precision.
[[nodiscard]] std::optional<SymMat3<double>> solutionCovariance(const SymMat3<double>& A, double residualVariance);

}  // namespace pdc
