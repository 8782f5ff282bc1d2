#pragma once

#include "pdc/sample/hermite_source.h"

namespace pdc {

/// An estimate of σn from the Hermite data alone: the standard deviation of a component of the unit normals along the
/// surface, from how far the normals of neighbouring crossings disagree with where the crossings lie. Curvature does
/// not count, nor do creases while they are few. White noise of 0.05 to 0.2 voxels in the values of a grid is found
/// within 30 % but on shapes of few voxels (docs/defaults.md). Noise in the normals of crossings that lie exactly is
/// underestimated by a sixth, because it is taken for noise in values, which moves crossings too. 0 if no two
/// neighbours have normals. \throws Cancelled; whatever the source throws.
[[nodiscard]] double normalNoise(const HermiteSource& source, const Monitor& monitor = {});

}  // namespace pdc
