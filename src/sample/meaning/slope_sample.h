#pragma once

#include <vector>

#include "sample/meaning/grid_meaning.h"
#include "sample/meaning/value_range.h"

namespace pdc::detail {

/// The lengths of gradients at some of the values.
class SlopeSample {
 public:
  /// \param range of the values.
  explicit SlopeSample(const ValueRange& range) : mRange(range) {}

  /// False for values that are clamped, at one of the ends of what there is.
  [[nodiscard]] bool isInBand(double v) const;
  /// \param slope per world unit, at a value.
  void add(double slope, double value);
  /// Sets what slopes say.
  void finish(GridEvidence& evidence);

 private:
  ValueRange mRange;
  std::vector<double> mSlopes, mSizes;  ///< One of each for every value that has a slope.
};

}  // namespace pdc::detail
