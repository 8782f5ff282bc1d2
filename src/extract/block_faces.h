#pragma once

#include <cstdint>

#include "extract/block_topology.h"
#include "extract/block_vertices.h"

namespace pdc::detail {

/// The errors of two runs of consecutive vertices, those of a window of blocks and of the one before.
struct ErrorWindow {
  const VertexError* previous;
  const VertexError* current;
  std::uint64_t previousFirst, currentFirst;

  [[nodiscard]] const VertexError& operator[](std::uint64_t vertex) const {
    return vertex >= currentFirst ? current[vertex - currentFirst] : previous[vertex - previousFirst];
  }
};

class CellVertices;

/// Writes the faces of blocks whose vertices and lower neighbours' vertices are solved: quad i of the topology to
/// quads[i]. Each starts at the corner that puts its diagonal where the summed
/// quadric error of its vertices, taken at the diagonal's midpoint, is smaller: shorter or smaller diagonals cut
/// creases off.
class BlockFaceWriter {
 public:
  BlockFaceWriter(const SurfaceBlocks& blocks, const Topology& topology, const LatticeMap& map, Quad* quads,
                  SimdLevel level)
      : mBlocks(blocks), mTopology(topology), mMap(map), mQuads(quads), mLevel(level) {}

  /// \param doubts null, or where quads go whose triangles may not both pass between the ends of their lattice edge.
  /// Such a quad is split along the other diagonal if that one passes.
  void run(std::size_t block, const ErrorWindow& errors, Doubts* doubts) const;

 private:
  template <int axis>
  void runAxis(std::size_t block, const CellVertices& vertices, const ErrorWindow& errors, Doubts* doubts,
               std::uint64_t face) const;
  void write(const Quad& v, bool splitsAtFirst, bool reversed, std::uint64_t face) const;

  const SurfaceBlocks& mBlocks;
  const Topology& mTopology;
  const LatticeMap& mMap;
  Quad* mQuads;
  SimdLevel mLevel;
};

}  // namespace pdc::detail
