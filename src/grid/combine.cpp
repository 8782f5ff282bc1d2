#include "pdc/grid/combine.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>

#include <cmath>
#include <stdexcept>

#include "grid/level_set.h"
#include "grid/real_grid.h"
#include "pdc/error.h"

namespace pdc {
namespace {

/// Bands that differ by less, in voxels, are as wide as each other.
constexpr double kSameWidth = 1e-3;

/// The other grid as one of the same lattice, type and band, which may be emptied.
openvdb::GridBase::Ptr alike(const GridVolume& volume, const GridVolume& other, const Monitor& monitor) {
  const double halfWidth = detail::halfWidthOf(volume);
  const bool same = other.grid->type() == volume.grid->type() && other.distances &&
                    other.grid->constTransform() == volume.grid->constTransform() &&
                    std::abs(detail::halfWidthOf(other) - halfWidth) <= kSameWidth;
  if (same) return other.grid->deepCopyGrid();
  return detail::levelSetOf(other, volume.grid->transform(), halfWidth, volume.grid->isType<openvdb::DoubleGrid>(),
                            monitor);
}

}  // namespace

void combineGrids(GridVolume& volume, CombineKind kind, const GridVolume& other, GridStepReport* report,
                  const Monitor& monitor) {
  if (!other.grid) throw std::invalid_argument("combineGrids: the other volume has no grid");
  if (other.gridClass != GridClass::kLevelSet)
    throw Error("only level sets can be combined, and the other grid is a fog volume");
  monitor.throwIfStopped();
  detail::StepRecord record(volume, report);
  detail::ensureDistances(volume, "combining grids", record, monitor);
  const openvdb::GridBase::Ptr second = alike(volume, other, monitor);
  monitor.throwIfStopped();
  detail::visitReal(volume, "combineGrids", [&](auto& grid) {
    using Grid = std::decay_t<decltype(grid)>;
    Grid& others = *openvdb::gridPtrCast<Grid>(second);
    switch (kind) {
      case CombineKind::kUnion:
        return openvdb::tools::csgUnion(grid, others);
      case CombineKind::kIntersect:
        return openvdb::tools::csgIntersection(grid, others);
      case CombineKind::kSubtract:
        return openvdb::tools::csgDifference(grid, others);
    }
  });
  record.finish(volume);
}

}  // namespace pdc
