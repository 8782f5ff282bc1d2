#pragma once

#include <functional>
#include <optional>

#include "pdc/math/mat3.h"

namespace pdc {

/// A map from lattice (index) space to world space: affine, or any smooth map with its Jacobian (a frustum).
class LatticeMap {
 public:
  using PositionFunction = std::function<Vec3d(const Vec3d&)>;
  using JacobianFunction = std::function<Mat3d(const Vec3d&)>;

  /// x_world = linear · x + translation. \throws Error if `linear` is singular or not finite.
  LatticeMap(const Mat3d& linear, const Vec3d& translation);
  /// A map that is not affine. Both functions are called from many threads at once. The determinant of the Jacobian
  /// must keep its sign, which is taken at `somewhere`. \throws std::invalid_argument if a function is missing; Error
  /// if the Jacobian is singular or not finite there.
  LatticeMap(PositionFunction position, JacobianFunction jacobian, const Vec3d& somewhere);

  [[nodiscard]] bool affine() const { return !mPosition; }
  [[nodiscard]] Vec3d position(const Vec3d& x) const { return affine() ? mLinear * x + mTranslation : mPosition(x); }
  /// This map with the world's origin at `origin`. \param step of rounded(); 0, or a power of two.
  [[nodiscard]] LatticeMap relativeTo(const Vec3d& origin, double step) const;
  /// A position as meshes hold it: in single precision, its coordinates multiples of step() unless that is 0. Each
  /// coordinate of the result is a function of that coordinate that does not decrease.
  [[nodiscard]] Vec3f rounded(const Vec3d& position) const {
    return vecCast<float>(mStep > 0 ? onStep(position) : position);
  }
  [[nodiscard]] double step() const { return mStep; }
  /// d(position)/dx, columns are the images of the lattice axes.
  [[nodiscard]] Mat3d jacobian(const Vec3d& x) const { return affine() ? mLinear : mJacobian(x); }
  /// True if the map turns right-handed frames into left-handed ones, so that faces must be wound the other way.
  [[nodiscard]] bool mirrored() const { return mMirrored; }
  /// Cube root of the volume of a voxel (for a map that is not affine: at `somewhere`), in world units.
  [[nodiscard]] double voxelSize() const { return mVoxelSize; }

 private:
  [[nodiscard]] Vec3d onStep(const Vec3d& p) const;

  Mat3d mLinear;
  Vec3d mTranslation{};
  PositionFunction mPosition;
  JacobianFunction mJacobian;
  bool mMirrored = false;
  double mVoxelSize = 1.0;
  double mStep = 0;
};

}  // namespace pdc
