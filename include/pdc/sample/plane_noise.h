#pragma once

#include <array>

#include "pdc/sample/hermite_block.h"

namespace pdc {

/// What is known of the noise in the planes of a block's crossings, in EdgeIndex order.
struct PlaneNoise {
  /// Standard deviation of each component of the unit normal (no unit, >= 0, finite), in addition to the σn that is
  /// assumed of all: variances add.
  std::array<float, HermiteBlock::kCapacity> sigma;
  /// How much the crossing's quadric counts beside others of its cell, >= 0 and finite. Weights below 1e-6 count as
  /// that, so that where none has weight all count the same.
  std::array<float, HermiteBlock::kCapacity> weight;
};

}  // namespace pdc
