#pragma once

#include <memory>

#include "extract/topology/patch_list.h"
#include "pdc/sample/hermite_source.h"

namespace pdc::detail {

/// Samples one block of a source after another into what places its vertices. For one thread; large: keep it off the
/// stack.
class BlockSampler {
 public:
  explicit BlockSampler(const HermiteSource& source)
      : mSource(source),
        mNoise(source.knowledge().noise != SourceKnowledge::Noise::kNone ? std::make_unique<PlaneNoise>() : nullptr) {}

  /// Replaces what the block before has left.
  void run(const SurfaceBlock& block, const BlockTopology& topology) {
    mSource.fillHermite(block, mHermite);
    if (mNoise != nullptr) mSource.fillNoise(block, mHermite, *mNoise);
    mPatches.fill(topology, block.signs);
    mFeatures.clear();
    mSource.fillFeaturePlanes(block, mHermite, mPatches.patches(), mFeatures);
  }

  [[nodiscard]] const HermiteSource& source() const { return mSource; }
  [[nodiscard]] const HermiteBlock& hermite() const { return mHermite; }
  /// Null: the source knows none.
  [[nodiscard]] const PlaneNoise* noise() const { return mNoise.get(); }
  [[nodiscard]] const PatchList& patches() const { return mPatches; }
  [[nodiscard]] const FeaturePlanes& features() const { return mFeatures; }

 private:
  const HermiteSource& mSource;
  HermiteBlock mHermite;
  const std::unique_ptr<PlaneNoise> mNoise;
  PatchList mPatches;
  FeaturePlanes mFeatures;
};

}  // namespace pdc::detail
