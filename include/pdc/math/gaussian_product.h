#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "pdc/math/quadric.h"
#include "pdc/math/solvers.h"
#include "pdc/math/sym_mat3.h"

/// Products of Gaussians (Preiner, Boubekeur & Wimmer 2019), whose equations are meant below. All functions are pure
/// and check nothing but what their results say.
namespace pdc {

/// The inverse of a positive definite matrix, by an LDLᵀ factorisation; nothing where solveLdlt() finds it is not.
[[nodiscard]] constexpr std::optional<SymMat3<double>> inversePositive(const SymMat3<double>& A) {
  Vec3d x{}, y{}, z{};
  const bool positive = detail::ldlt(A, {1, 0, 0}, x) && detail::ldlt(A, {0, 1, 0}, y) && detail::ldlt(A, {0, 0, 1}, z);
  if (!positive) return std::nullopt;
  return SymMat3<double>{x.x, y.x, z.x, y.y, z.y, z.z};
}

/// A normal distribution over space. It is kept by the inverse of its covariance, because that is what products add up.
struct Gaussian {
  Vec3d mean;
  SymMat3<double> precision;  ///< Σ⁻¹, positive definite, in 1 / length².

  /// Nothing if the covariance is not positive definite.
  [[nodiscard]] static constexpr std::optional<Gaussian> fromCovariance(const Vec3d& mean,
                                                                        const SymMat3<double>& covariance) {
    const auto inverse = inversePositive(covariance);
    if (!inverse) return std::nullopt;
    return Gaussian{mean, *inverse};
  }
  /// Σ. Zero if the precision is not positive definite.
  [[nodiscard]] constexpr SymMat3<double> covariance() const {
    return inversePositive(precision).value_or(SymMat3<double>::zero());
  }
};

/// The point of the nine-dimensional dual space that stands for a Gaussian (equations 10 and 11): the normal equations
/// of its exponent. There a product is a sum. It is that of a quadric, so products of Gaussians and sums of quadrics
/// are one thing.
[[nodiscard]] constexpr NormalEquations<double> dualOf(const Gaussian& g) {
  return {g.precision, g.precision * g.mean};
}

/// The Gaussian of a point of the dual space (equation 12); nothing outside the cone of positive definite matrices.
[[nodiscard]] constexpr std::optional<Gaussian> fromDual(const NormalEquations<double>& q) {
  const auto mean = solveLdlt(q.A, q.b);
  if (!mean) return std::nullopt;
  return Gaussian{*mean, q.A};
}

/// The sum of a product of powers of Gaussians (equation 13), relative to a reference point. Near the means it loses
/// nothing to the distance from the origin, however flat the covariances are; a dual point would.
class GaussianSum {
 public:
  constexpr explicit GaussianSum(const Vec3d& reference) : mReference(reference) {}

  constexpr void add(const Gaussian& g, double weight) {
    const SymMat3<double> weighted = g.precision * weight;
    mPrecision += weighted;
    mMoment += weighted * (g.mean - mReference);
  }
  /// Multiplies all weights so far.
  constexpr void scale(double factor) {
    mPrecision = mPrecision * factor;
    mMoment *= factor;
  }
  /// The normalised product. Where the sum is not positive definite to working precision, which weights >= 0 exclude,
  /// its mean is the reference.
  [[nodiscard]] constexpr Gaussian result() const {
    return {mReference + solveLdlt(mPrecision, mMoment).value_or(Vec3d{0, 0, 0}), mPrecision};
  }

 private:
  Vec3d mReference;
  SymMat3<double> mPrecision = SymMat3<double>::zero();
  Vec3d mMoment{0, 0, 0};
};

/// The normalised product of the powers of some Gaussians (equations 6 and 13). \param weights the exponents, one for
/// each, >= 0 and not all 0; a common factor of them scales the precision only.
[[nodiscard]] constexpr Gaussian product(std::span<const Gaussian> gaussians, std::span<const double> weights) {
  GaussianSum sum(gaussians.front().mean);
  for (std::size_t i = 0; i < gaussians.size(); ++i) sum.add(gaussians[i], weights[i]);
  return sum.result();
}

/// The point at t, from 0 at a's mean to 1 at b's, of the curve that joins two Gaussians (equation 5). It leaves a
/// along Σa Σb⁻¹ (b − a), and is a straight line where the covariances are multiples of each other.
[[nodiscard]] constexpr Gaussian gaussianCurve(const Gaussian& a, const Gaussian& b, double t) {
  GaussianSum sum(a.mean);
  sum.add(a, 1 - t);
  sum.add(b, t);
  return sum.result();
}

}  // namespace pdc
