#pragma once

#include <cstdint>

#include "extract/topology/surface.h"
#include "extract/topology/suspect_vertex.h"
#include "extract/vertices/placed_quadrics.h"
#include "pdc/math/simd_level.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Writes the faces of blocks whose vertices and lower neighbours' vertices are solved: quad i of the topology to
/// quads[i]. Each starts at the corner that puts its diagonal where the summed
/// quadric error of its vertices, taken at the diagonal's midpoint, is smaller: shorter or smaller diagonals cut
/// creases off.
class BlockFaceWriter {
 public:
  BlockFaceWriter(const Surface& surface, Quad* quads, SimdLevel level)
      : mBlocks(surface.blocks),
        mTopology(surface.topology),
        mMap(surface.source.map()),
        mQuads(quads),
        mLevel(level) {}

  /// \param suspects null, or where quads go whose triangles may not both pass between the ends of their lattice edge.
  /// Such a quad is split along the other diagonal if that one passes.
  void run(std::size_t block, const PlacedQuadrics& quadrics, Suspects* suspects) const;

 private:
  class Block;

  const SurfaceBlocks& mBlocks;
  const Topology& mTopology;
  const LatticeMap& mMap;
  Quad* mQuads;
  SimdLevel mLevel;
};

}  // namespace pdc::detail
