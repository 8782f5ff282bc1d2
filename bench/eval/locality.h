#pragma once

#include <cstddef>

#include "pdc/mesh/mesh.h"
#include "pdc/sample/hermite_source.h"

namespace pdc::eval {

/// Blocks from `lo` to `hi`, both included.
struct BlockBox {
  Coord lo, hi;

  /// Whether a block lies in the box or not farther from it than so many blocks.
  [[nodiscard]] bool holds(const Coord& b, int grown) const {
    for (int axis = 0; axis < 3; ++axis)
      if (b[axis] < lo[axis] - grown || b[axis] > hi[axis] + grown) return false;
    return true;
  }
};

/// How two meshes differ where both should be the same.
struct FaceDifference {
  std::size_t faces = 0;      ///< Of the first one, there.
  std::size_t different = 0;  ///< That only one of them has.
};

/// Contours a box of blocks with two blocks around it, and compares what lies wholly in the box with the mesh of the
/// whole: the places of vertices, diagonals and fans. \param blocks those of the source. For maps along the axes.
[[nodiscard]] FaceDifference compareWithPart(const HermiteSource& source, const SurfaceBlocks& blocks,
                                             const Mesh& whole, const BlockBox& box);

}  // namespace pdc::eval
