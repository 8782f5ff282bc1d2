#pragma once

#include "extract/topology/block_topology.h"

namespace pdc::detail {

/// Checks what HermiteSource::surfaceBlocks() promises and quads rely on: that every cell about a lattice edge with a
/// quad is there and has a vertex. Runs in parallel. \throws std::invalid_argument that names the first block beside
/// which a cell is missing.
void checkContinuation(const SurfaceBlocks& blocks, const Topology& topology);

}  // namespace pdc::detail
