#pragma once

#include "pdc/field/field.h"
#include "pdc/sample/hermite_block.h"
#include "sample/implicit/lattice_frame.h"
#include "sample/implicit/missing_points.h"

namespace pdc::detail {

// Points at which the field is NaN are outside, and added to `missing` if that is not null.

/// Samples the 9×9×9 points of a block; see isInside(). Leaves `cells` alone.
void sampleSigns(const Field& field, const LatticeFrame& frame, const Coord& block, BlockSigns& signs,
                 MissingPoints* missing);

/// True if the sides differ among every fourth point of the block, 3×3×3 in all.
[[nodiscard]] bool coarseSignsDiffer(const Field& field, const LatticeFrame& frame, const Coord& block,
                                     MissingPoints* missing);

/// True if the sides differ on the face of the block across `axis`, on its lower or upper end.
[[nodiscard]] bool faceSignsDiffer(const BlockSigns& signs, int axis, bool upper);

/// The cells of a block that lie in [0, cells).
[[nodiscard]] CellMask cellsWithin(const Coord& block, const Coord& cells);

}  // namespace pdc::detail
