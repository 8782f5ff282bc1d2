#include "extract/vertices/sigma_normal.h"

#include <algorithm>

namespace pdc::detail {
namespace {

/// No share of the excess is as large: two exact normals may disagree with a chord across a crease by all that they
/// differ.
constexpr double kAnything = 1e9;

}  // namespace

SigmaNormal SigmaNormal::ofNoise(double noise) {
  SigmaNormal sigma(0);
  sigma.mOfPatches = true;
  sigma.setNoise(noise);
  return sigma;
}

SigmaNormal SigmaNormal::fromData(const HermiteSource& source) {
  const SourceKnowledge knowledge = source.knowledge();
  SigmaNormal sigma = ofNoise(0);
  sigma.mOwnNoise = knowledge.noise == SourceKnowledge::Noise::kSigma;
  sigma.mAllCreases = knowledge.allCreases;
  if (knowledge.exactNormals) {
    sigma.mCertainShare = kCertainShareOfExact;
    sigma.mMostOfCrease = kAnything;
  }
  sigma.mNeedsNoise = !sigma.mOwnNoise && !knowledge.exactNormals;
  return sigma;
}

void SigmaNormal::setNoise(double noise) {
  if (!mOfPatches) return;
  mNoise = noise;
  const double least = std::max(kLeast, noise);
  mVariance = least * least;
}

}  // namespace pdc::detail
