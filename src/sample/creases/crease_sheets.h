#pragma once

#include <array>
#include <span>

#include "pdc/math/mat3.h"
#include "pdc/math/simd_level.h"
#include "sample/creases/surface_samples.h"

namespace pdc::detail {

/// One smooth sheet of the surface near a cell, to second order: {y : n·d + ½ dᵀHd = offset} with d = y − center.
struct CreaseSheet {
  Vec3d center;  ///< Mean of the points it was made of.
  Vec3d normal;  ///< At the centre; of unit length.
  Mat3d bend;    ///< How the normal changes along the surface, H; symmetric.
  double offset;
  double support;  ///< The sum of that of its samples.

  [[nodiscard]] Vec3d gradient(const Vec3d& y) const { return normal + bend * (y - center); }
  /// The signed distance of y, to second order.
  [[nodiscard]] double value(const Vec3d& y) const {
    const Vec3d d = y - center;
    return dot(normal, d) + 0.5 * dot(d, bend * d) - offset;
  }
};

/// The sheets that meet near a cell.
struct CreaseSheets {
  static constexpr int kMax = 4;
  std::array<CreaseSheet, kMax> sheet;
  int count = 0;

  [[nodiscard]] std::span<const CreaseSheet> all() const { return {sheet.data(), static_cast<std::size_t>(count)}; }
  void drop(int i) { sheet[i] = sheet[--count]; }
  /// Drops the sheets with less than `share` of the largest support.
  void dropUnsupported(double share);
};

/// One-sided slopes of second order have this many times the noise of values.
inline constexpr double kNormalNoise = 4;

/// Sorts samples into sheets by their normals: the sheet about the sample that weighs most first, then those of what is
/// left. Takes the samples' support. The sheets are in the space of the samples' foot points. \param normalNoise
/// expected of each component of a normal. \param level changes no bit of them.
[[nodiscard]] CreaseSheets findSheets(SurfaceSamples& samples, double normalNoise, SimdLevel level = bestSimdLevel());

/// The point that is nearest to all sheets, weighted by their support (at most 1 each), and, as far as they leave it
/// open, to `start`: three Gauss-Newton steps. \param sigma as σn of their normals.
[[nodiscard]] Vec3d meetingPoint(std::span<const CreaseSheet> sheets, const Vec3d& start, double sigma);

}  // namespace pdc::detail
