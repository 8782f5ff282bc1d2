#pragma once

#include <openvdb/Grid.h>

#include <string>
#include <vector>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc {

/// What a grid holds at the vertices of a mesh, by OpenVDB's samplers, through the grid's own transform; active and
/// inactive voxels count alike, and beyond what is stored it is the background.
///
/// Float and double grids (halves are read as floats) and vectors of three of these are trilinear between voxels
/// (BoxSampler), staggered vectors component by component (StaggeredBoxSampler). Whole numbers and bools have the value
/// of the nearest voxel (PointSampler), since they may name things. Vectors keep their components as they are stored.
///
/// \returns one property of the name given, of type float, double, int32, double for int64, uint8 for bool, with one
/// component or three; but for real vectors named "Cd", which are colours by custom: "red", "green" and "blue", uint8,
/// 0 to 1 as 0 to 255, what lies beyond cut off, NaN as 0. Blanks and control characters in names become "_".
/// \throws Error for other types of grids, naming those that can be sampled; std::invalid_argument for an empty name;
/// Cancelled. Runs in parallel. Progress: none.
[[nodiscard]] std::vector<VertexProperty> gridAttribute(const openvdb::GridBase& grid, const std::string& name,
                                                        const Mesh& mesh, const Monitor& monitor = {});

}  // namespace pdc
