#pragma once

#include <vector>

#include "pdc/field/field.h"
#include "pdc/sample/hermite_source.h"

namespace pdc {

/// Points, in world units, on the sharp edges of the surface where a field is zero, which is the source's surface,
/// about one per voxel of their length, found from the source's Hermite data: where neighbouring crossings' normals
/// differ by more than 30 degrees, the part of the surface between them is halved, each time keeping the half with the
/// larger turn, down to 1e-4 voxels; it is sharp if 25 degrees are left. Features that no square of the lattice sees
/// are not found. The same points for any number of threads. \throws std::invalid_argument for null; Cancelled;
/// whatever the source throws.
[[nodiscard]] std::vector<Vec3f> creasePoints(const FieldPtr& field, const HermiteSource& source,
                                              const Monitor& monitor = {});

}  // namespace pdc
