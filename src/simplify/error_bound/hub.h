#pragma once

#include <cstddef>
#include <cstdint>

#include "simplify/vertex_stars.h"

namespace pdc::detail {

/// Whether so many faces meet at an edge's ends that it is not collapsed where there is a bound on the error: that
/// takes time with the square of their number and more, and makes all neighbours wait. Without a limit cones of 2000
/// faces and more did not end in 45 seconds, with 256 they take up to five; vertices of other meshes have some tens of
/// faces. Where the faces about a hub go it may be none any more.
[[nodiscard]] inline bool isHub(const VertexStars& stars, std::uint32_t a, std::uint32_t b) {
  constexpr std::size_t kMostFaces = 256;
  return stars[a].size() + stars[b].size() > kMostFaces;
}

}  // namespace pdc::detail
