#pragma once

#include <memory>
#include <vector>

#include "pdc/field/field.h"
#include "pdc/math/sym_mat3.h"
#include "pdc/points/gaussian_mixture.h"
#include "points/point_tree.h"

namespace pdc::detail {

/// How a mixture was made; what tells noise from what was added to it.
struct MixtureScale {
  double sigma0;  ///< The deviation that each point's Gaussian began with.
  double points;  ///< How many points share the weights.
};

/// The ridge of a mixture as a function that is negative inside. Gaussian i is a plane through its mean μi whose normal
/// ni is the direction of the least eigenvalue λ3, turned as the distances d to a rough surface rise. Where |d| ≤ σ0,
///
///     f(x) = (Σ ki (x − μi)·ni + ε d) / (Σ ki + ε),
///     ki = wi (exp(−m²/2) − exp(−c²/2)),  m² = (q − μi)ᵀ Σi⁻¹ (q − μi) < c²,
///
/// where q is the rough surface's point that is nearest to x: at x itself a plane that goes on beyond a crease would
/// count there. From σ0 to 2σ0 f turns into d, as it does where no Gaussian reaches. By the weights
///
///     wi = v / (v + ei) · (1 − λ3/λ2)²,  ei = max(0, λ3 − σ0²),
///
/// v the median of all ei, flat Gaussians count more than those that bend over a crease, and those without a direction
/// do not count. Gradients are those with d's gradient, q and the ki held constant.
///
/// The planes of neighbours rise over a curved surface by as much as their means lie below it, to first order, so that
/// curvature moves nothing. Assumed: the rough surface is within σ0 of the points' own.
class MixtureField final : public Field {
 public:
  /// \param rough signed distances in world units, at least within 2σ0.
  MixtureField(const GaussianMixture& mixture, const MixtureScale& scale, FieldPtr rough);

  void values(PointSpan points, double* values) const override;
  void gradients(PointSpan points, double* values, GradientSpan gradients) const override;
  [[nodiscard]] Interval bound(const Box& box) const override;

  /// The standard deviation of the normal near a point of the surface: the root of the mean of (v + ei) / (λ2 Ni) by
  /// the ki, which is the variance of the slope of a line through Ni points.
  [[nodiscard]] double normalDeviation(const Vec3d& p) const;

 private:
  struct Plane {
    Vec3d mean, normal;
    SymMat3<double> precision;
    double weight, slopeVariance;
  };
  /// What the Gaussians near a point say.
  struct Blend {
    double weight = 0, distance = 0, slopeVariance = 0;  ///< Sums by the ki.
    Vec3d normal{0, 0, 0};                               ///< Likewise.
  };

  [[nodiscard]] Vec3d roughGradient(const Vec3d& p) const;
  [[nodiscard]] Blend blendAt(const Vec3d& p, double distance, const Vec3d& gradient) const;

  FieldPtr mRough;
  double mNear, mFar;
  std::vector<Vec3d> mMeans;
  std::vector<Plane> mPlanes;
  std::unique_ptr<PointTree> mTree;  ///< Of mMeans.
  double mReach = 0;                 ///< No Gaussian counts farther from its mean.
};

}  // namespace pdc::detail
