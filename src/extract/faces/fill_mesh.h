#pragma once

#include "extract/topology/surface.h"
#include "extract/topology/suspect_vertex.h"
#include "extract/vertices/block_vertices.h"
#include "extract/vertices/sigma_normal.h"
#include "pdc/math/simd_level.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

struct FillMeshOptions {
  SigmaNormal sigma;
  double halfSize;                    ///< See VertexSolver.
  bool normals = false;               ///< Also the mesh's normals.
  SimdLevel level = bestSimdLevel();  ///< Changes no bit of the mesh.
};

/// Solves all vertices and writes all faces, in parallel, to the mesh's positions, normals and quads, which it sizes.
///
/// It works through the blocks in runs of whole x-slabs, so that what faces need to know of vertices is still in cache
/// and soon forgotten: a block's faces use its own vertices and those of blocks at most one slab before.
/// \param suspects null, or where to note what may intersect, by ascending vertex and edge.
VertexCounts fillMesh(const Surface& surface, const FillMeshOptions& options, Mesh& mesh, Suspects* suspects,
                      const Monitor& monitor);

}  // namespace pdc::detail
