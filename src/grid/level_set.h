#pragma once

#include <openvdb/Grid.h>

#include <cstdint>

#include "grid/real_grid.h"
#include "pdc/grid/grid_volume.h"
#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

/// What the steps on level sets have in common.
namespace pdc::detail {

/// Half the width of a band, in voxels, as most tools make it and all of them suffice with.
inline constexpr double kHalfWidth = 3;

/// What each voxel of a level set takes while it is made of a mesh: leaves of a band are half full, and each voxel has
/// a value and, for a time, the number of a face.
inline constexpr double kBandBytes = 2 * (sizeof(float) + sizeof(std::int32_t) + 4);

/// A lattice of cubes: as `old` has it where that has cubes, with the point 0, 0, 0 and the axes that they have, else
/// along the axes of the world.
[[nodiscard]] openvdb::math::Transform::Ptr cubicTransform(const openvdb::math::Transform& old, double voxelSize);

/// Distances to a mesh, negative inside of it, as openvdb::tools::meshToVolume() finds them, from coordinates in double
/// precision. \param transform of cubes. \param halfWidth in voxels. \param doubles makes a DoubleGrid.
/// \throws Error if the grid is not expected to fit into the memory, or the mesh lies beyond what coordinates hold;
/// Cancelled.
[[nodiscard]] openvdb::GridBase::Ptr levelSetFromMesh(const Mesh& mesh, const openvdb::math::Transform& transform,
                                                      double halfWidth, bool doubles, const Monitor& monitor);

/// The level set of a volume's contour, on another lattice of cubes. What is thrown is as for levelSetFromMesh().
[[nodiscard]] openvdb::GridBase::Ptr levelSetOf(const GridVolume& volume, const openvdb::math::Transform& transform,
                                                double halfWidth, bool doubles, const Monitor& monitor);

/// Makes the volume that level set, of its own type.
void rebuildLevelSet(GridVolume& volume, const openvdb::math::Transform& transform, double halfWidth,
                     const Monitor& monitor);

/// Makes sure that the values of a level set are distances in a band that tools can work with; rebuilds it otherwise,
/// and says so. `step` is what errors call the step. \throws Error for a fog volume, and for voxels that are no cubes.
void ensureDistances(GridVolume& volume, const char* step, StepRecord& record, const Monitor& monitor);

/// The band's half width in voxels, at least three.
[[nodiscard]] double halfWidthOf(const GridVolume& volume);

/// \throws Error if what becomes of the active values of a grid on another lattice is not expected to fit into the
/// memory, or into what coordinates hold.
void checkResampling(const openvdb::GridBase& grid, const openvdb::math::Transform& target);

/// \throws Error if a grid of so many voxels, of so many bytes each, is not expected to fit into the memory.
void checkVoxels(double voxels, double bytesEach);

}  // namespace pdc::detail
