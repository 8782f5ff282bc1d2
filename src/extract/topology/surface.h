#pragma once

#include "extract/topology/block_topology.h"
#include "pdc/sample/hermite_source.h"

namespace pdc::detail {

/// What every stage of a contour works on. The three belong together and outlive whoever holds this.
struct Surface {
  const HermiteSource& source;
  const SurfaceBlocks& blocks;
  const Topology& topology;
};

}  // namespace pdc::detail
