#pragma once

#include <cstdint>

#include "extract/block_topology.h"
#include "extract/block_vertices.h"

namespace pdc::detail {

/// Writes the faces of all blocks in parallel: quad i of the topology to quads[i], or to triangles[2i] and [2i + 1].
/// Each starts at the corner that puts its diagonal where the summed quadric error of its vertices, taken at the
/// diagonal's midpoint, is smaller: shorter or smaller diagonals cut creases off. \param quads, triangles one of them
/// null.
void writeFaces(const SurfaceBlocks& blocks, const Topology& topology, const VertexError* errors, bool mirrored,
                Quad* quads, Triangle* triangles, const Monitor& monitor);

}  // namespace pdc::detail
