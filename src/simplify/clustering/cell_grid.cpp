#include "simplify/clustering/cell_grid.h"

#include <fmt/format.h>

#include "pdc/error.h"

namespace pdc::detail {

void CellGrid::refuse(const Vec3f& p) const {
  throw Error(fmt::format(
      "the corner {:g}, {:g}, {:g} is too far away: cells of edge {:g} reach {} steps from the first corner, "
      "and 2^50 from the origin",
      p.x, p.y, p.z, mCell, kMostSteps));
}

}  // namespace pdc::detail
