#pragma once

#include <optional>

#include "pdc/study/sweep.h"

namespace pdc::detail {

/// How far a mesh is from the truth, in voxels: the root of the summed squares of vertexRms and, if known, creaseRms.
/// Empty without a truth.
[[nodiscard]] std::optional<double> trueError(const SweepStep& step);

/// Sets `recommended` and `reason` of a sweep over σn that has a step; see sweepSigma().
void recommendSigma(Sweep& sweep);

}  // namespace pdc::detail
