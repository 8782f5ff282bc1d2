#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pdc/math/vec3.h"
#include "simplify/pair_contraction/linked_faces.h"

namespace pdc::detail {

/// Two vertices without a common face that are to become one, with their faces.
struct MergingEnds {
  std::uint32_t a, b;
  std::span<const StarCorner> starA, starB;
};

struct RemovedPockets {
  std::size_t faces = 0;
  std::vector<Triangle> away;          ///< Those of them that were at neither end.
  std::vector<std::uint32_t> corners;  ///< Of the walls that are gone on both sides, besides the ends; in any number.
};

/// Removes those faces that come to have the vertices of others when the ends become one, but for one of each. Where
/// the two faced each other neither is left: the walls of a gap between solids go with the gap. So do walls that are
/// split into triangles along different diagonals, which are the four faces of a tetrahedron then.
[[nodiscard]] RemovedPockets removePockets(LinkedFaces& faces, const std::vector<Vec3d>& positions,
                                           const MergingEnds& ends);

}  // namespace pdc::detail
