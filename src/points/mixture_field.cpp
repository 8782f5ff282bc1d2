#include "points/mixture_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "parallel/for_each_in_parallel.h"
#include "pdc/math/gaussian_product.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kGrain = 256;
/// Gaussians end at this many deviations.
constexpr double kCut = 3.5;
/// What the rough distance weighs, so that it takes over smoothly where Gaussians end.
constexpr double kRoughWeight = 1e-6;
/// The least noise that is assumed, as a share of σ0.
constexpr double kLeastNoise = 1e-2;
constexpr double kNear = 1, kFar = 2;  ///< In σ0.

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// From 0 at `a` to 1 at `b`.
double smoothStep(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

MixtureField::MixtureField(const GaussianMixture& mixture, const MixtureScale& scale, FieldPtr rough)
    : mRough(std::move(rough)),
      mNear(kNear * scale.sigma0),
      mFar(kFar * scale.sigma0),
      mMeans(mixture.means.begin(), mixture.means.end()),
      mPlanes(mixture.size()) {
  const double added = scale.sigma0 * scale.sigma0;
  std::vector<double> noise(mixture.size()), reach(mixture.size());
  forEachInParallel(mixture.size(), kGrain, [&](std::uint32_t i) {
    noise[i] = std::max(0.0, eigenSymmetric(mixture.covariances[i]).value[2] - added);
  });
  const double usual = std::max(medianOf(noise), kLeastNoise * kLeastNoise * added);
  forEachInParallel(mixture.size(), kGrain, [&](std::uint32_t i) {
    const Eigen3 eigen = eigenSymmetric(mixture.covariances[i]);
    const Vec3d step = eigen.vector[2] * mFar;
    const bool rises = mRough->valueAt(mMeans[i] + step) >= mRough->valueAt(mMeans[i] - step);
    const double flatness = 1 - eigen.value[2] / eigen.value[1], variance = usual + noise[i];
    mPlanes[i] = {.mean = mMeans[i],
                  .normal = rises ? eigen.vector[2] : -eigen.vector[2],
                  .precision = inversePositive(mixture.covariances[i]).value_or(SymMat3<double>::zero()),
                  .weight = usual / variance * flatness * flatness,
                  .slopeVariance = variance / (eigen.value[1] * mixture.weights[i] * scale.points)};
    reach[i] = kCut * std::sqrt(eigen.value[0]);
  });
  mReach = *std::max_element(reach.begin(), reach.end());
  mTree = std::make_unique<PointTree>(mMeans);
}

MixtureField::Blend MixtureField::blendAt(const Vec3d& p, double distance, const Vec3d& gradient) const {
  static const double atCut = std::exp(-0.5 * kCut * kCut);
  Blend blend;
  const double slope = length(gradient);
  if (!(slope > 0)) return blend;
  const Vec3d outwards = gradient * (1 / slope), foot = p - outwards * distance;
  mTree->visitWithin(foot, mReach, [&](std::uint32_t i, double) {
    const Plane& plane = mPlanes[i];
    const double squared = quadraticForm(plane.precision, foot - plane.mean);
    // The other side of a thin part is not this one's surface.
    if (squared >= kCut * kCut || dot(plane.normal, outwards) < 0) return;
    const double k = plane.weight * (std::exp(-0.5 * squared) - atCut);
    blend.weight += k;
    blend.distance += k * dot(plane.normal, p - plane.mean);
    blend.normal += plane.normal * k;
    blend.slopeVariance += k * plane.slopeVariance;
  });
  return blend;
}

void MixtureField::values(PointSpan points, double* values) const {
  std::array<double, kMaxBatch> x, y, z;
  gradients(points, values, {x.data(), y.data(), z.data()});
}

void MixtureField::gradients(PointSpan points, double* values, GradientSpan gradients) const {
  mRough->gradients(points, values, gradients);
  for (std::size_t i = 0; i < points.size; ++i) {
    const double d = values[i];
    if (!(std::abs(d) < mFar)) continue;
    const Vec3d p{points.x[i], points.y[i], points.z[i]}, g{gradients.x[i], gradients.y[i], gradients.z[i]};
    const Blend blend = blendAt(p, d, g);
    const double rough = smoothStep(mNear, mFar, std::abs(d)), sum = blend.weight + kRoughWeight;
    values[i] = (blend.distance + kRoughWeight * d) / sum * (1 - rough) + d * rough;
    const Vec3d gradient = (blend.normal + g * kRoughWeight) * ((1 - rough) / sum) + g * rough;
    gradients.x[i] = gradient.x;
    gradients.y[i] = gradient.y;
    gradients.z[i] = gradient.z;
  }
}

Interval MixtureField::bound(const Box& box) const {
  const Interval rough = mRough->bound(box);
  if (rough.lo >= mFar || rough.hi <= -mFar) return rough;
  // No plane that counts passes farther from a point.
  const double most = mFar + mReach;
  return {std::min(rough.lo, -most), std::max(rough.hi, most)};
}

double MixtureField::normalDeviation(const Vec3d& p) const {
  const Blend blend = blendAt(p, mRough->valueAt(p), mRough->gradientAt(p));
  return blend.weight > 0 ? std::sqrt(blend.slopeVariance / blend.weight) : 0;
}

}  // namespace pdc::detail
