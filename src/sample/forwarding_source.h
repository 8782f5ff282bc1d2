#pragma once

#include "pdc/sample/hermite_source.h"

namespace pdc::detail {

/// Another source, all of it; for sources that change a part of what it says. The other one must outlive this.
class ForwardingSource : public HermiteSource {
 public:
  explicit ForwardingSource(const HermiteSource& source) : mSource(source) {}

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override {
    return mSource.surfaceBlocks(monitor);
  }
  [[nodiscard]] std::optional<SurfaceForecast> forecast(const Monitor& monitor) const override {
    return mSource.forecast(monitor);
  }
  [[nodiscard]] const LatticeMap& map() const override { return mSource.map(); }
  [[nodiscard]] SourceKnowledge knowledge() const override { return mSource.knowledge(); }
  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override {
    mSource.fillHermite(block, hermite);
  }
  void fillNoise(const SurfaceBlock& block, const HermiteBlock& hermite, PlaneNoise& noise) const override {
    mSource.fillNoise(block, hermite, noise);
  }
  void fillFeaturePlanes(const SurfaceBlock& block, const HermiteBlock& hermite, std::span<const SurfacePatch> patches,
                         FeaturePlanes& planes) const override {
    mSource.fillFeaturePlanes(block, hermite, patches, planes);
  }
  void prefetch(const Coord& block) const override { mSource.prefetch(block); }

 private:
  const HermiteSource& mSource;
};

}  // namespace pdc::detail
