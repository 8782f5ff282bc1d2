#pragma once

#include "extract/topology/block_topology.h"
#include "extract/vertices/block_vertices.h"
#include "pdc/math/simd_level.h"

namespace pdc::detail {

/// Solves all vertices and writes all faces, in parallel, to the mesh's positions, normals and quads, which it sizes.
/// Works through the blocks in windows of whole x-slabs, so that what faces need to know of vertices is still in cache
/// and soon forgotten: a block's faces use its own vertices and those of blocks at most one slab before. \param level
/// changes no bit of it. \param doubts null, or where to note what may intersect, by ascending vertex and edge.
VertexCounts fillMesh(const HermiteSource& source, const SurfaceBlocks& blocks, const Topology& topology,
                      const ContourOptions& options, Mesh& mesh, Doubts* doubts, const Monitor& monitor,
                      SimdLevel level = bestSimdLevel());

}  // namespace pdc::detail
