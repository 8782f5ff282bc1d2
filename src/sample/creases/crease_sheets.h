#pragma once

#include <array>
#include <cmath>
#include <span>

#include "pdc/math/mat3.h"
#include "pdc/math/simd_level.h"
#include "sample/creases/surface_samples.h"

namespace pdc::detail {

/// Sums over the samples of a sheet: of their support, and, by their fit weights, of ones, normals n, foot points f,
/// the six products f fᵀ and the nine n fᵀ.
struct SheetMoments {
  enum { kSupport, kFitWeight, kNormal, kFoot = kNormal + 3, kFootFoot = kFoot + 3, kNormalFoot = kFootFoot + 6 };
  static constexpr int kCount = kNormalFoot + 9;
  std::array<double, kCount> sum{};

  [[nodiscard]] Vec3d vector(int first) const { return {sum[first], sum[first + 1], sum[first + 2]}; }
  SheetMoments& operator+=(const SheetMoments& other) {
    for (int i = 0; i < kCount; ++i) sum[i] += other.sum[i];
    return *this;
  }
};

/// One smooth sheet of the surface near a cell, to second order: {y : n·d + ½ dᵀHd = offset} with d = y − center.
struct CreaseSheet {
  Vec3d center;  ///< Mean of the points it was made of.
  Vec3d normal;  ///< At the centre; of unit length.
  Mat3d bend;    ///< How the normal changes along the surface, H; symmetric.
  double offset;
  double support;  ///< The sum of that of its samples.
  SheetMoments moments{};
  double heightError = 0;  ///< See NoisyFit; only where samples are noisy.
  int number = 0;          ///< Its place in SheetWeights.

  /// The mean curvature, twice: positive where the surface is convex.
  [[nodiscard]] double traceOfBend() const { return bend.row[0].x + bend.row[1].y + bend.row[2].z; }
  /// The norm of the bend, per voxel.
  [[nodiscard]] double bendSize() const {
    return std::sqrt(dot(bend.row[0], bend.row[0]) + dot(bend.row[1], bend.row[1]) + dot(bend.row[2], bend.row[2]));
  }
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

/// The fit weight of each sample in each sheet, where samples are noisy; 0 for samples of other sheets.
struct SheetWeights {
  alignas(64) std::array<std::array<float, SurfaceSamples::kCapacity>, CreaseSheets::kMax> of;
  alignas(64) std::array<float, SurfaceSamples::kCapacity> joined;  ///< By joinSheets().
};

/// True for normals that do not say best how a sheet lies, because they are made of differences.
constexpr bool isNoisy(double normalNoise) { return normalNoise > 0.01; }

/// One-sided slopes of second order have this many times the noise of values.
inline constexpr double kNormalNoise = 4;

/// Sorts samples into sheets by their normals: the sheet about the sample that weighs most first, then those of what is
/// left. Takes the samples' support. The sheets are in the space of the samples' foot points. \param normalNoise
/// expected of each component of a normal. \param weights gets those of the sheets where isNoisy(). \param level
/// changes no bit of them.
[[nodiscard]] CreaseSheets findSheets(SurfaceSamples& samples, double normalNoise, SheetWeights& weights,
                                      SimdLevel level = bestSimdLevel());

/// The sheet that is made of the samples of two. Where isNoisy(), `weights` gets its weights.
[[nodiscard]] CreaseSheet joinSheets(const SurfaceSamples& samples, const CreaseSheet& a, const CreaseSheet& b,
                                     double normalNoise, SheetWeights& weights, SimdLevel level = bestSimdLevel());

/// The point that is nearest to all sheets, weighted by their support (at most 1 each), and, as far as they leave it
/// open, to `start`: three Gauss-Newton steps. \param sigma as σn of their normals.
[[nodiscard]] Vec3d meetingPoint(std::span<const CreaseSheet> sheets, const Vec3d& start, double sigma);

}  // namespace pdc::detail
