#pragma once

#include "pdc/math/quadric.h"

/// Minimisers of quadrics by Eigen's solvers, for float and double, in a file of their own since they take minutes to
/// compile.
namespace pdc::bench {

template <typename T>
Vec3<T> solveJacobiSvd(const Quadric<T>& f);

/// For so small a matrix this is JacobiSVD with some overhead.
template <typename T>
Vec3<T> solveBdcSvd(const Quadric<T>& f);

/// Uses SelfAdjointEigenSolver::computeDirect.
template <typename T>
Vec3<T> solveEigenDirect(const Quadric<T>& f);

}  // namespace pdc::bench
