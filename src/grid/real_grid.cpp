#include "grid/real_grid.h"

#include <utility>

namespace pdc::detail {

void replaceGrid(GridVolume& volume, const openvdb::GridBase::Ptr& grid) {
  const std::string name = volume.grid->getName();
  const bool half = volume.grid->saveFloatAsHalf();
  for (auto it = volume.grid->beginMeta(); it != volume.grid->endMeta(); ++it)
    if (!(*grid)[it->first] && it->second) grid->insertMeta(it->first, *it->second);
  grid->setName(name);
  grid->setSaveFloatAsHalf(half);
  grid->setGridClass(volume.gridClass == GridClass::kLevelSet ? openvdb::GRID_LEVEL_SET : openvdb::GRID_FOG_VOLUME);
  volume.grid = grid;
}

StepRecord::StepRecord(const GridVolume& volume, GridStepReport* report)
    : mReport(report), mBefore(report != nullptr && volume.grid ? volume.grid->activeVoxelCount() : 0) {}

void StepRecord::finish(const GridVolume& volume) {
  if (mReport == nullptr) return;
  mReport->voxelsBefore = mBefore;
  mReport->voxelsAfter = volume.grid->activeVoxelCount();
  if (mReport->voxelsAfter == 0 && mBefore > 0) mWarnings.push_back("nothing is left of the grid");
  mReport->warnings = std::move(mWarnings);
}

}  // namespace pdc::detail
