#pragma once

#include <optional>

#include "pdc/sample/hermite_source.h"

namespace pdc::detail {

/// What the positions of a mesh are relative to, and the step that their coordinates are multiples of; 0 stands for
/// whatever single precision holds.
struct MeshOrigin {
  Vec3d origin{};
  double step = 0;
};

/// \param wanted the origin, or nothing to have it chosen: zero as long as single precision is finer than
/// kMostRounding there, else near the centre of the blocks. \param exactSums asks for a step at which origin + position
/// is exact in double precision; the origin is then rounded to it. \throws Error if single precision
/// cannot tell neighbouring voxels apart relative to a given origin.
[[nodiscard]] MeshOrigin meshOrigin(const LatticeMap& map, const SurfaceBlocks& blocks,
                                    const std::optional<Vec3d>& wanted, bool exactSums);

}  // namespace pdc::detail
