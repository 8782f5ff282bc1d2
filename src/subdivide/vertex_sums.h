#pragma once

#include "pdc/math/gaussian_product.h"

// What subdivision makes new vertices from: points for the linear schemes, Gaussians for the others. A sum of either is
// relative to a reference near by, so that nothing is lost to the distance from the origin.
namespace pdc::detail {

/// An affine combination of points.
class PointSum {
 public:
  explicit PointSum(const Vec3d& reference) : mReference(reference) {}
  void add(const Vec3d& p, double weight) { mMoment += (p - mReference) * weight; }
  void scale(double factor) { mMoment *= factor; }
  [[nodiscard]] Vec3d result() const { return mReference + mMoment; }

 private:
  Vec3d mReference, mMoment{0, 0, 0};
};

inline const Vec3d& placeOf(const Vec3d& p) { return p; }
inline const Vec3d& placeOf(const Gaussian& g) { return g.mean; }

template <typename Value>
struct SumOf;
template <>
struct SumOf<Vec3d> {
  using Type = PointSum;
};
template <>
struct SumOf<Gaussian> {
  using Type = GaussianSum;
};

/// The sum that makes a vertex of this type, with its first part.
template <typename Value>
typename SumOf<Value>::Type startSum(const Value& first, double weight) {
  typename SumOf<Value>::Type sum(placeOf(first));
  sum.add(first, weight);
  return sum;
}

}  // namespace pdc::detail
