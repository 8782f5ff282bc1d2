#include "pdc/grid/fog_to_level_set.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "grid/level_set.h"
#include "grid/real_grid.h"
#include "pdc/error.h"

namespace pdc {

void fogToLevelSet(GridVolume& volume, double iso, GridStepReport* report, const Monitor& monitor) {
  if (!std::isfinite(iso)) throw std::invalid_argument("fogToLevelSet: the isovalue must be finite");
  if (!volume.grid) throw std::invalid_argument("fogToLevelSet: the volume has no grid");
  if (volume.gridClass == GridClass::kLevelSet) throw Error("the grid is a level set already, and no fog volume");
  monitor.throwIfStopped();
  detail::StepRecord record(volume, report);
  const openvdb::math::Transform& old = volume.grid->transform();
  auto target = old.copy();
  if (!old.isLinear() || !old.hasUniformScale()) {
    const openvdb::CoordBBox active = volume.grid->evalActiveVoxelBoundingBox();
    const openvdb::Vec3d size = old.voxelSize(active.empty() ? openvdb::Vec3d(0) : active.getCenter());
    const double edge = std::min({size.x(), size.y(), size.z()});
    record.warn(fmt::format("voxels of {:.6g} x {:.6g} x {:.6g} are no cubes; the level set has cubes of {:.6g}",
                            size.x(), size.y(), size.z(), edge));
    target = detail::cubicTransform(old, edge);
  }
  volume.iso = iso;
  detail::rebuildLevelSet(volume, *target, detail::kHalfWidth, monitor);
  record.finish(volume);
}

}  // namespace pdc
