#pragma once

#include <utility>

#include "pdc/sample/hermite_source.h"

namespace pdc::detail {

/// Another source, all of it, with its lattice elsewhere in the world.
class RelocatedSource final : public HermiteSource {
 public:
  RelocatedSource(const HermiteSource& source, LatticeMap map) : mSource(source), mMap(std::move(map)) {}

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override {
    return mSource.surfaceBlocks(monitor);
  }
  [[nodiscard]] std::optional<SurfaceForecast> forecast(const Monitor& monitor) const override {
    return mSource.forecast(monitor);
  }
  [[nodiscard]] const LatticeMap& map() const override { return mMap; }
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
  LatticeMap mMap;
};

}  // namespace pdc::detail
