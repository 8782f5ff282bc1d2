#include "pdc/sample/lattice_map.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "math/nearest_multiple.h"
#include "pdc/error.h"

namespace pdc {
namespace {

// Below this share of the volume a right-angled voxel of the same edge lengths would have, normals and the sense of
// faces are rounding noise.
constexpr double kSmallestRelativeVolume = 1e-12;

struct VoxelShape {
  bool mirrored;
  double size;
};

VoxelShape voxelShape(const Mat3d& linear) {
  Mat3d unit;
  double size = 1;
  for (int i = 0; i < 3; ++i) {
    const Vec3d c = linear.column(i);
    const double edge = std::hypot(c.x, c.y, c.z);
    if (!std::isfinite(edge)) throw Error("lattice map is not finite");
    if (edge == 0) throw Error(fmt::format("lattice map is singular: axis {} has length 0", i));
    unit.row[i] = c * (1 / edge);
    size *= std::cbrt(edge);
  }
  const double relativeVolume = unit.determinant();
  if (!(std::abs(relativeVolume) >= kSmallestRelativeVolume))
    throw Error(fmt::format("lattice map is singular: relative volume of a voxel is {}, at least {} is needed",
                            std::abs(relativeVolume), kSmallestRelativeVolume));
  return {relativeVolume < 0, size * std::cbrt(std::abs(relativeVolume))};
}

}  // namespace

LatticeMap::LatticeMap(const Mat3d& linear, const Vec3d& translation) : mLinear(linear), mTranslation(translation) {
  if (!std::isfinite(translation.x) || !std::isfinite(translation.y) || !std::isfinite(translation.z))
    throw Error("lattice map is not finite");
  const VoxelShape shape = voxelShape(linear);
  mMirrored = shape.mirrored;
  mVoxelSize = shape.size;
}

LatticeMap::LatticeMap(PositionFunction position, JacobianFunction jacobian, const Vec3d& somewhere)
    : mPosition(std::move(position)), mJacobian(std::move(jacobian)) {
  if (!mPosition || !mJacobian) throw std::invalid_argument("LatticeMap: a function is missing");
  const VoxelShape shape = voxelShape(mJacobian(somewhere));
  mMirrored = shape.mirrored;
  mVoxelSize = shape.size;
}

LatticeMap LatticeMap::relativeTo(const Vec3d& origin, double step) const {
  LatticeMap moved = *this;
  moved.mStep = step;
  moved.mTranslation = mTranslation - origin;
  if (!affine()) moved.mPosition = [position = mPosition, origin](const Vec3d& x) { return position(x) - origin; };
  return moved;
}

Vec3d LatticeMap::onStep(const Vec3d& p) const { return detail::nearestMultiple(p, mStep); }

}  // namespace pdc
