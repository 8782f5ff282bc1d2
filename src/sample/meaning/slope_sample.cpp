#include "sample/meaning/slope_sample.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pdc::detail {
namespace {

/// A sample of fewer slopes says nothing.
constexpr std::size_t kLeastSlopes = 32;

/// \returns 0 if there are too few to say something.
double median(std::vector<double> values) {
  if (values.size() < kLeastSlopes) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

bool SlopeSample::isInBand(double v) const {
  const double margin = kAtBandEnd * (mRange.high - mRange.low);
  return v > mRange.low + margin && v < mRange.high - margin;
}

void SlopeSample::add(double slope, double value) {
  mSlopes.push_back(slope);
  mSizes.push_back(std::abs(value));
}

void SlopeSample::finish(GridEvidence& evidence) {
  evidence.slope = median(mSlopes);
  if (!(evidence.slope > 0)) return;
  std::vector<double> atZero;
  for (std::size_t i = 0; i < mSlopes.size(); ++i)
    if (mSizes[i] < evidence.slope * evidence.voxelSize) atZero.push_back(mSlopes[i]);
  evidence.slopeAtZero = median(std::move(atZero));
  for (double& slope : mSlopes) slope = std::abs(slope / evidence.slope - 1);
  evidence.slopeSpread = median(std::move(mSlopes));
}

}  // namespace pdc::detail
