#pragma once

#include "pdc/sample/lattice.h"
#include "sample/creases/distance_stencil.h"

namespace pdc::detail {

/// Whoever can read the values about a block. Its functions may be called from many threads at once.
class DistanceReader {
 public:
  virtual ~DistanceReader() = default;
  /// Reads the values about a block, times `scale`, into the rows that the stencil asks for; NaN where a value is
  /// clamped or not finite. Other rows are left as they are.
  virtual void readDistances(const Coord& block, float scale, DistanceStencil& stencil) const = 0;
};

}  // namespace pdc::detail
