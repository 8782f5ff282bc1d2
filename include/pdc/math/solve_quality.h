#pragma once

#include <optional>

#include "pdc/math/sym_mat3.h"

/// How far the solution of Ax = b can be trusted.
namespace pdc {

struct SolveQuality {
  double condition;  ///< Largest over smallest eigenvalue; infinite if the smallest is not positive, and for A = 0.
  int rank;          ///< Number of eigenvalues above the cut-off.
};

/// \param A symmetric, positive semidefinite up to rounding.
/// \param relativeCutoff eigenvalues at or below this share of the largest count as zero, as in solvePseudoInverse.
[[nodiscard]] SolveQuality solveQuality(const SymMat3<double>& A, double relativeCutoff);

/// Covariance of the minimiser of a sum of squared residuals (nᵢᵀx − dᵢ)², A = Σ nᵢnᵢᵀ, whose dᵢ are independent with
/// one variance: residualVariance A⁻¹ (Gauss-Markov). An unbiased estimate of that variance from m residuals is
/// f(x_min) / (m − 3). \returns nothing if A is not positive definite to working precision.
[[nodiscard]] std::optional<SymMat3<double>> solutionCovariance(const SymMat3<double>& A, double residualVariance);

}  // namespace pdc
