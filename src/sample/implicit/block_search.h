#pragma once

#include "pdc/sample/hermite_source.h"
#include "sample/implicit/lattice_frame.h"
#include "sample/implicit/missing_points.h"
#include "sample/implicit/simplified_fields.h"

namespace pdc::detail {

/// Where to look for the zero set of a field.
struct BlockSearch {
  const SimplifiedFields& fields;
  LatticeFrame frame;
  Coord cells;  ///< The lattice: cells [0, cells) on each axis.
  bool open;    ///< Only cells of the lattice take part; otherwise the field must be outside on and beyond its limits.
  MissingPoints* missing = nullptr;  ///< Points at which the field is NaN; null: they are outside, and no error.
};

/// The blocks of the lattice that hold surface, sorted by coordinate: descent from one box over all, then growth across
/// block faces (see FieldSource). Reports the stage "sample".
[[nodiscard]] SurfaceBlocks findSurfaceBlocks(const BlockSearch& search, const Monitor& monitor);

}  // namespace pdc::detail
