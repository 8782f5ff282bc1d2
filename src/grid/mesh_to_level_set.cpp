#include "pdc/grid/mesh_to_level_set.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <stdexcept>

#include "grid/level_set.h"
#include "mesh/mesh_checks.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc {

GridVolume meshToLevelSet(const Mesh& mesh, const MeshToLevelSetOptions& options, GridStepReport* report,
                          const Monitor& monitor) {
  const double voxel = options.voxelSize,
               width = options.halfWidth == 0 ? detail::kHalfWidth * voxel : options.halfWidth;
  if (!std::isfinite(voxel) || !(voxel > 0))
    throw std::invalid_argument("meshToLevelSet: the voxel size must be finite and above 0");
  if (!std::isfinite(width) || !(width >= voxel))
    throw std::invalid_argument("meshToLevelSet: the half width must be finite and a voxel at least");
  detail::checkSizes(mesh, "meshToLevelSet", detail::FaceKinds::kTrianglesAndQuads);
  detail::checkIndices(mesh);
  monitor.throwIfStopped();
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  GridVolume volume{.grid = detail::levelSetFromMesh(mesh, *transform, width / voxel, false, monitor)};
  volume.distances = width >= detail::kHalfWidth * voxel;
  if (report == nullptr) return volume;
  report->voxelsAfter = volume.grid->activeVoxelCount();
  const std::size_t open = analyze(mesh).boundaryEdges;
  if (open > 0)
    report->warnings.push_back(
        fmt::format("the mesh has {} boundary edges: what is inside of it is not certain", open));
  return volume;
}

}  // namespace pdc
