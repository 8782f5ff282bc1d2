#include "extract/vertices/sigma_normal.h"

#include <algorithm>
#include <utility>

#include "pdc/sample/normal_noise.h"

namespace pdc::detail {
namespace {

/// Blocks that are looked at for noise.
constexpr std::size_t kBlocks = 64;

/// Some blocks of another source.
class SomeBlocks final : public HermiteSource {
 public:
  SomeBlocks(const HermiteSource& source, SurfaceBlocks blocks) : mSource(source), mBlocks(std::move(blocks)) {}

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor&) const override { return mBlocks; }
  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override {
    mSource.fillHermite(block, hermite);
  }
  [[nodiscard]] const LatticeMap& map() const override { return mSource.map(); }

 private:
  const HermiteSource& mSource;
  SurfaceBlocks mBlocks;
};

}  // namespace

SigmaNormal SigmaNormal::ofNoise(double noise) {
  SigmaNormal sigma(std::max(kLeast, noise));
  sigma.mNoise = noise;
  sigma.mOfPatches = true;
  return sigma;
}

SigmaNormal SigmaNormal::ofOwnNoise() {
  SigmaNormal sigma = ofNoise(0);
  sigma.mOwnNoise = true;
  return sigma;
}

SigmaNormal SigmaNormal::fromData(const HermiteSource& source, const SurfaceBlocks& blocks, const Monitor& monitor) {
  if (source.knowledge().noise == SourceKnowledge::Noise::kSigma) return ofOwnNoise();
  SurfaceBlocks some;
  const std::size_t all = blocks.coords.size(), count = std::min(kBlocks, all);
  for (std::size_t i = 0; i < count; ++i) {
    some.coords.push_back(blocks.coords[i * all / count]);
    some.signs.push_back(blocks.signs[i * all / count]);
  }
  return ofNoise(normalNoise(SomeBlocks(source, std::move(some)), monitor));
}

}  // namespace pdc::detail
