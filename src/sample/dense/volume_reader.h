#pragma once

#include <memory>
#include <vector>

#include "pdc/sample/hermite_block.h"
#include "sample/dense/volume_sampler.h"
#include "sample/dense/volume_signs.h"
#include "sample/stencils/distance_reader.h"
#include "sample/stencils/gradient_stencil.h"

namespace pdc::detail {

/// Reads the values of a volume about its blocks into stencils. What lies beyond the volume, or has no data, is NaN.
class VolumeReader final : public DistanceReader {
 public:
  /// \param mask null, or which points have data; it must outlive this.
  VolumeReader(const VolumeView& view, const ValueReading& reading, const VolumeSigns* mask)
      : mSampler(makeVolumeSampler(view, reading)), mLimits(slopeLimits(reading)), mMask(mask) {}

  [[nodiscard]] const VolumeSampler& sampler() const { return *mSampler; }
  [[nodiscard]] const SlopeLimits& limits() const { return mLimits; }

  /// Reads the rows that a block's crossings need.
  void readGradients(const Coord& block, const EdgeIndex& edges, GradientStencil& stencil) const;
  void readDistances(const Coord& block, float scale, DistanceStencil& stencil) const override;
  /// Hints that readGradients() will soon be called for a block.
  void prefetch(const Coord& block) const;
  /// Up to `most` blocks whose values are not all the same; see sampleOfBlocks(). Of more than some hundred thousand
  /// blocks only so many are looked at.
  [[nodiscard]] std::vector<Coord> someBlocks(std::size_t most) const;

 private:
  void read(const PointRows& box) const;
  [[nodiscard]] bool isConstant(const Coord& block) const;

  std::unique_ptr<const VolumeSampler> mSampler;
  SlopeLimits mLimits;
  const VolumeSigns* mMask;
};

}  // namespace pdc::detail
