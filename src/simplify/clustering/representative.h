#pragma once

#include "pdc/simplify/cluster.h"
#include "simplify/clustering/cell_sums.h"

namespace pdc::detail {

/// Which of a cell's places its vertex takes.
struct RepresentativeRule {
  bool definite;    ///< Whether sums of the quadrics have one minimum.
  double halfSize;  ///< The farthest from the cell's centre along each axis, in cells.

  explicit RepresentativeRule(const ClusterOptions& options);
};

struct Representative {
  Vec3d place;   ///< From the cell's centre, in cells.
  bool outside;  ///< Whether the minimum lies outside of the cell.
};

/// The place of least error within the rule's cube; the mean of the corners where quadrics say nothing.
[[nodiscard]] Representative representative(const CellSums& sums, const RepresentativeRule& rule);

}  // namespace pdc::detail
