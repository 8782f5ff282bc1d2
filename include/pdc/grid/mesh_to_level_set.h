#pragma once

#include "pdc/grid/grid_volume.h"
#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc {

struct MeshToLevelSetOptions {
  double voxelSize = 0;  ///< World units, finite and above 0.
  double halfWidth = 0;  ///< Of the band, world units, finite; 0: three voxels. At least one voxel otherwise.
};

/// A level set of floats with the distances to a mesh, by openvdb::tools::meshToVolume(): outside is what can be
/// reached from afar. The mesh should be closed; the report warns of boundaries. Faces with more than four corners have
/// to be triangles before: triangulatePolygons().
/// \throws std::invalid_argument for options that are not as they say, and a mesh as Mesh says; Error for coordinates
/// beyond what a lattice holds, NaN included, and for what does not fit into the memory; Cancelled.
[[nodiscard]] GridVolume meshToLevelSet(const Mesh& mesh, const MeshToLevelSetOptions& options,
                                        GridStepReport* report = nullptr, const Monitor& monitor = {});

}  // namespace pdc
