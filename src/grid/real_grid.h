#pragma once

#include <openvdb/openvdb.h>

#include <stdexcept>
#include <string>

#include "pdc/grid/grid_volume.h"

namespace pdc::detail {

/// The types of grids that can be processed.
using RealGrids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid>;

/// Calls visit(grid) with the grid's own type. \throws std::invalid_argument for a volume that settleGrid() would not
/// make; `who` names the function that was called.
template <typename Visit>
void visitReal(GridVolume& volume, const char* who, Visit&& visit) {
  if (!volume.grid || !volume.grid->apply<RealGrids>(visit))
    throw std::invalid_argument(std::string(who) + ": the volume has no grid of floats or doubles");
}

/// Puts another grid of the same meaning in the place of the volume's, under its name and metadata.
void replaceGrid(GridVolume& volume, const openvdb::GridBase::Ptr& grid);

/// Fills in what a step did once it is done: counts voxels before and after, and says where nothing is left.
class StepRecord {
 public:
  /// \param report null, or where it is written when finish() is called.
  StepRecord(const GridVolume& volume, GridStepReport* report);
  void warn(std::string warning) { mWarnings.push_back(std::move(warning)); }
  void finish(const GridVolume& volume);

 private:
  GridStepReport* mReport;
  std::size_t mBefore;
  std::vector<std::string> mWarnings;
};

}  // namespace pdc::detail
