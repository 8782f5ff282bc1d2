#pragma once

#include <random>

#include "pdc/math/quadric.h"

namespace pdc {

/// Points, directions and covariances from a fixed seed.
class RandomGeometry {
 public:
  explicit RandomGeometry(unsigned seed) : mEngine(seed) {}

  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(mEngine); }
  double normal() { return mNormal(mEngine); }
  /// Normally distributed about the origin, with covariance I.
  Vec3d point() { return {normal(), normal(), normal()}; }
  Vec3d direction() {
    const Vec3d v = point();
    return v * (1 / length(v));
  }
  Mat3d matrix() { return {{point(), point(), point()}}; }
  Mat3d rotation() {
    const Vec3d x = direction();
    const Vec3d n = cross(x, direction());
    const Vec3d y = n * (1 / length(n));
    return {{x, y, cross(x, y)}};
  }
  /// Standard normal points times this have covariance covarianceOf(it).
  Mat3d covarianceRoot(double scale) { return matrix() * scale; }
  static SymMat3<double> covarianceOf(const Mat3d& root) {
    return congruence(SymMat3<double>::identity(), root.transposed());
  }
  SymMat3<double> covariance(double scale) { return covarianceOf(covarianceRoot(scale)); }

 private:
  std::mt19937_64 mEngine;
  std::normal_distribution<double> mNormal;
};

}  // namespace pdc
