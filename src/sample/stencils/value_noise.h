#pragma once

#include "pdc/sample/hermite_source.h"
#include "sample/stencils/distance_reader.h"

namespace pdc::detail {

/// What is known of the noise of values: their standard deviations and weights, on the same lattice. Either may be
/// null. What they point to must outlive this.
struct ValueNoise {
  const DistanceReader* sigma = nullptr;
  const DistanceReader* weight = nullptr;

  [[nodiscard]] SourceKnowledge::Noise knowledge() const;
  /// See HermiteSource::fillNoise. \param values are those that have the noise.
  void fill(const Coord& block, const EdgeIndex& edges, const HermiteBlock& hermite, const DistanceReader& values,
            PlaneNoise& noise) const;
  /// The largest σ at the block's crossings, in the units of the values. \pre sigma is not null.
  [[nodiscard]] double largestSigma(const Coord& block, const EdgeIndex& edges, const HermiteBlock& hermite) const;
};

}  // namespace pdc::detail
