#pragma once

#include <memory>

#include "pdc/sample/hermite_source.h"

namespace pdc {

/// Another source's blocks and Hermite data, sampled once and kept: whoever contours it several times, with different
/// options, samples once. Meshes are the same, byte for byte, as those of the source itself.
///
/// Takes 16 bytes per crossing and block that sees it, about 2 kB per block. A block's data is found by its coordinate:
/// only blocks of its own surfaceBlocks() may be asked for. The source must live as long: planes beyond the crossings
/// and their noise are asked of it each time.
class SampledSource final : public HermiteSource {
 public:
  /// Runs in parallel on the calling thread's arena. \throws Cancelled, whatever the source throws.
  explicit SampledSource(const HermiteSource& source, const Monitor& monitor = {});
  ~SampledSource() override;

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override;
  [[nodiscard]] const LatticeMap& map() const override { return mMap; }
  [[nodiscard]] SourceKnowledge knowledge() const override { return mSource.knowledge(); }
  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override;
  void fillNoise(const SurfaceBlock& block, const HermiteBlock& hermite, PlaneNoise& noise) const override {
    mSource.fillNoise(block, hermite, noise);
  }
  void fillFeaturePlanes(const SurfaceBlock& block, const HermiteBlock& hermite, std::span<const SurfacePatch> patches,
                         FeaturePlanes& planes) const override {
    mSource.fillFeaturePlanes(block, hermite, patches, planes);
  }

  /// Crossings kept, those that several blocks see counted for each.
  [[nodiscard]] std::size_t crossings() const { return mCrossings.size(); }

 private:
  struct Crossing {
    float t, nx, ny, nz;
  };

  const HermiteSource& mSource;
  LatticeMap mMap;
  SurfaceBlocks mBlocks;
  std::vector<std::size_t> mFirst;  ///< mCrossings of block i begin at mFirst[i].
  Buffer<Crossing> mCrossings;
};

}  // namespace pdc
