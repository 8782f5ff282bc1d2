#include "simplify/clustering/representative.h"

#include "pdc/math/solvers.h"

namespace pdc::detail {
namespace {

/// Eigenvalues below this share of the largest leave their directions open (Lindstrom 2000).
constexpr double kRankCutoff = 1e-3;

/// How strongly a minimum that leaves its cell is held in those directions: enough to be one point.
constexpr double kOpen = 1e-6;

/// How far free vertices may go from the centres of their cells.
constexpr double kFreeHalfSize = 2;

/// Whether noise makes sums of these quadrics definite, or they are so by themselves.
bool isDefinite(const ClusterOptions& options) {
  switch (options.quadric) {
    case QuadricKind::kPlane:
    case QuadricKind::kTriangle:
      return false;
    case QuadricKind::kProbabilisticPlane:
      return options.sigmaNormal > 0;
    case QuadricKind::kProbabilisticTriangle:
      return options.sigmaPosition > 0;
    case QuadricKind::kPoint:
      break;
  }
  return true;
}

/// A without its small eigenvalues, but with something in their place.
SymMat3<double> withoutSmall(const SymMat3<double>& A) {
  const Eigen3 eigen = eigenSymmetric(A);
  const double largest = eigen.value[0];
  SymMat3<double> kept = SymMat3<double>::zero();
  for (std::size_t i = 0; i < 3; ++i)
    kept = kept + outer(eigen.vector[i]) * (eigen.value[i] > kRankCutoff * largest ? eigen.value[i] : kOpen * largest);
  return kept;
}

}  // namespace

RepresentativeRule::RepresentativeRule(const ClusterOptions& options)
    : definite(isDefinite(options)), halfSize(options.free ? kFreeHalfSize : 0.5) {}

Representative representative(const CellSums& sums, const RepresentativeRule& rule) {
  const auto& [A, b] = sums.error;
  if (rule.definite) {
    if (const auto x = solveLdlt(A, b)) return {minimizeInCube(A, b, *x, rule.halfSize), largestEntry(*x) > 0.5};
  }
  const Vec3d mean = sums.corners * (1 / sums.count);
  const Vec3d x = minimizeNear({A, b, 0}, mean, kRankCutoff);
  const bool outside = largestEntry(x) > 0.5;
  if (largestEntry(x) <= rule.halfSize) return {x, outside};
  const SymMat3<double> kept = withoutSmall(A);
  return {minimizeInCube(kept, kept * x, x, rule.halfSize), outside};
}

}  // namespace pdc::detail
