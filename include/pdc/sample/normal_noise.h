#pragma once

#include "pdc/sample/hermite_source.h"

namespace pdc {

/// An estimate of σn from the Hermite data alone: how much a component of a unit normal differs from one crossing to
/// the next, as a standard deviation. By the median over all pairs of neighbours, so that creases do not count as noise
/// while they are few; the turn of a curved surface within a voxel does count. 0 if no two neighbours have normals.
/// \throws Cancelled; whatever the source throws.
[[nodiscard]] double normalNoise(const HermiteSource& source, const Monitor& monitor = {});

}  // namespace pdc
