#pragma once

#include "math/root_histogram.h"
#include "pdc/math/mat3.h"
#include "pdc/math/simd_level.h"
#include "pdc/sample/hermite_block.h"

namespace pdc::detail {

/// How far normals disagree with the places of their crossings, counted by size.
///
/// Where two points lie on a surface that bends evenly, the mean of their normals is perpendicular to the chord between
/// them, however much it bends: s = (n₁ + n₂) · (p₂ − p₁) / |p₂ − p₁| is zero to third order, while noise shows in it.
/// Beside a crease it is anything up to the sine of the crease's angle, so a median tells of noise as long as creases
/// are few.
class NormalNoiseHistogram {
 public:
  /// Counts the pairs of crossings that are neighbours both on the surface and in EdgeIndex order. \param M from
  /// lattice steps to world space. \param level changes no count.
  void add(const HermiteBlock& hermite, const EdgeIndex& edges, const Mat3f& M, SimdLevel level = bestSimdLevel());
  NormalNoiseHistogram& operator+=(const NormalNoiseHistogram& other) {
    mSizes += other.mSizes;
    return *this;
  }

  /// Pairs that were counted.
  [[nodiscard]] std::uint64_t count() const { return mSizes.total(); }
  /// The standard deviation of a component of the normals along the surface; `certain` pairs without noise are added,
  /// so that a few do not tell of noise alone. 0 if there are none.
  [[nodiscard]] double sigma(std::uint64_t certain = 0) const;

 private:
  RootHistogram mSizes;  ///< The sizes of s.
};

}  // namespace pdc::detail
