#pragma once

#include <cstdint>

#include "pdc/points/gaussian_mixture.h"

namespace pdc::detail {

/// How one level is to be merged. `samples` is |P| of the paper, the number of points that the weights share.
struct LevelOptions {
  double alpha;
  int iterations;
  double samples;
  std::uint64_t level;
};

/// Whether others are merged into the Gaussian with this mean: a third of all, by what their means are, so that it does
/// not matter where in which list they stand.
[[nodiscard]] bool isParent(const Vec3d& mean, std::uint64_t level);

/// Merges Gaussians of a mixture that is in spatial order. \returns those of the next level, in spatial order. \throws
/// Error if there are too many pairs for the memory; Cancelled.
[[nodiscard]] GaussianMixture mergeLevel(const GaussianMixture& mixture, const LevelOptions& options,
                                         MixtureLevelReport& report, const Monitor& monitor);

}  // namespace pdc::detail
