#pragma once

#include <memory>

#include "extract/topology/patch_list.h"
#include "extract/vertices/cell_metric.h"
#include "pdc/sample/hermite_source.h"
#include "sample/normal_noise_histogram.h"

namespace pdc::detail {

/// Samples one block of a source after another into what places its vertices. For one thread; large: keep it off the
/// stack.
class BlockSampler {
 public:
  /// \param estimateNoise whether normalNoise() is wanted.
  explicit BlockSampler(const HermiteSource& source, bool estimateNoise = false)
      : mSource(source),
        mEstimateNoise(estimateNoise),
        mNoise(source.knowledge().noise != SourceKnowledge::Noise::kNone ? std::make_unique<PlaneNoise>() : nullptr) {}

  /// Replaces what the block before has left.
  void run(const SurfaceBlock& block, const BlockTopology& topology, const CellMetric& metric) {
    mSource.fillHermite(block, mHermite);
    if (mEstimateNoise) {
      mAgreement = {};
      mAgreement.add(mHermite, block.edges, matCast<float>(metric.M));
    }
    if (mNoise != nullptr) mSource.fillNoise(block, mHermite, *mNoise);
    mPatches.fill(topology, block.signs);
    mFeatures.clear();
    mSource.fillFeaturePlanes(block, mHermite, mPatches.patches(), mFeatures);
  }

  [[nodiscard]] const HermiteSource& source() const { return mSource; }
  [[nodiscard]] const HermiteBlock& hermite() const { return mHermite; }
  /// Null: the source knows none.
  [[nodiscard]] const PlaneNoise* noise() const { return mNoise.get(); }
  /// How well the block's normals agree with where its crossings lie; empty unless it was asked for.
  [[nodiscard]] const NormalNoiseHistogram& agreement() const { return mAgreement; }
  /// The noise of the block's normals; 0 unless it was asked for.
  [[nodiscard]] double normalNoise() const { return mAgreement.sigma(kCertainPairs); }
  [[nodiscard]] const PatchList& patches() const { return mPatches; }
  [[nodiscard]] const FeaturePlanes& features() const { return mFeatures; }

 private:
  /// Fewer pairs do not tell noise from what a few cells happen to hold.
  static constexpr std::uint64_t kCertainPairs = 4;

  const HermiteSource& mSource;
  const bool mEstimateNoise;
  HermiteBlock mHermite;
  NormalNoiseHistogram mAgreement;
  const std::unique_ptr<PlaneNoise> mNoise;
  PatchList mPatches;
  FeaturePlanes mFeatures;
};

}  // namespace pdc::detail
