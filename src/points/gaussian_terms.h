#pragma once

#include <cmath>

#include "pdc/math/gaussian_product.h"
#include "pdc/math/sym_mat3.h"

namespace pdc::detail {

/// |A|.
[[nodiscard]] inline double determinant(const SymMat3<double>& a) {
  return a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) + a.xz * (a.xy * a.yz - a.yy * a.xz);
}

/// What formulas on pairs of Gaussians need of each.
struct GaussianTerms {
  Vec3d mean;
  SymMat3<double> covariance, precision;  ///< Σ and Σ⁻¹.
  double logDeterminant;                  ///< ln |Σ|.

  GaussianTerms(const Vec3d& mu, const SymMat3<double>& sigma)
      : mean(mu),
        covariance(sigma),
        precision(inversePositive(sigma).value_or(SymMat3<double>::zero())),
        logDeterminant(std::log(determinant(sigma))) {}
};

/// The parts that the divergence and the likelihood of a child under a parent share.
struct PairTerms {
  double distance;  ///< (μc − μp)ᵀ Σp⁻¹ (μc − μp).
  double trace;     ///< tr(Σp⁻¹ Σc).

  PairTerms(const GaussianTerms& parent, const Vec3d& mean, const SymMat3<double>& covariance)
      : distance(quadraticForm(parent.precision, mean - parent.mean)),
        trace(traceOfProduct(parent.precision, covariance)) {}
};

/// D_KL(child‖parent).
[[nodiscard]] inline double divergence(const PairTerms& pair, double parentLog, double childLog) {
  return 0.5 * (pair.trace + pair.distance - 3 + parentLog - childLog);
}

/// ln of f(μ_child | parent) exp(−½ tr(Σp⁻¹ Σc)), which a power makes the likelihood of appendix A.
[[nodiscard]] inline double logLikelihoodOfOne(const PairTerms& pair, double parentLog) {
  constexpr double kLogTwoPi = 1.8378770664093454836;
  return -0.5 * (3 * kLogTwoPi + parentLog + pair.distance + pair.trace);
}

/// The standard deviation along the longest axis.
[[nodiscard]] inline double longestDeviation(const SymMat3<double>& covariance) {
  return std::sqrt(eigenSymmetric(covariance).value[0]);
}

}  // namespace pdc::detail
