#pragma once

#include <array>
#include <span>

#include "pdc/math/mat3.h"
#include "sample/creases/voxel_planes.h"

namespace pdc::detail {

/// One smooth side of the surface near a cell, to second order: {y : n·d + ½ dᵀHd = offset} with d = y − center.
struct SurfaceSide {
  Vec3d center;  ///< Mean of the points it was made of.
  Vec3d normal;  ///< At the centre; of unit length.
  Mat3d bend;    ///< How the normal changes along the surface, H; symmetric.
  double offset;
  double weight;  ///< Of all samples together.

  [[nodiscard]] Vec3d gradient(const Vec3d& y) const { return normal + bend * (y - center); }
  /// Distance of y from it, by and large.
  [[nodiscard]] double value(const Vec3d& y) const {
    const Vec3d d = y - center;
    return dot(normal, d) + 0.5 * dot(d, bend * d) - offset;
  }
};

/// The sides that meet near a cell.
struct SurfaceSides {
  static constexpr int kMax = 4;
  std::array<SurfaceSide, kMax> side;
  int count = 0;

  [[nodiscard]] std::span<const SurfaceSide> all() const { return {side.data(), static_cast<std::size_t>(count)}; }
  void drop(int i) { side[i] = side[--count]; }
  /// Drops the sides that weigh less than `share` of the heaviest.
  void dropLight(double share);
};

/// One-sided slopes of second order have this many times the noise of values.
inline constexpr double kNormalNoise = 4;

/// Sorts samples into sides by their normals: the heaviest first, then what is left of them. Spoils the samples'
/// weights. The sides are in the space of the samples' feet. \param normalNoise expected of each component of a normal.
/// \param level changes no bit of them.
[[nodiscard]] SurfaceSides findSides(SurfaceSamples& samples, double normalNoise, SimdLevel level = bestSimdLevel());

/// The point that is nearest to all sides, by their weights (at most 1 each), and, as far as they leave it open, to
/// `start`. \param sigma as σn of their normals.
[[nodiscard]] Vec3d meetingPoint(std::span<const SurfaceSide> sides, const Vec3d& start, double sigma);

}  // namespace pdc::detail
