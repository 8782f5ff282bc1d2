#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/local/local_frame.h"
#include "simplify/vertex_noise.h"

namespace pdc::detail {

/// What decimation works on, in its local frame.
struct DecimatedSurface {
  LocalFrame frame;
  std::vector<Vec3d> positions;
  Buffer<Triangle> faces;
  std::vector<std::uint8_t> locked;  ///< By vertex, whether it stays where it is.
  VertexNoise noise;
  std::span<const Vec3f> given;  ///< By vertex, its place in the mesh given.

  /// The place of a vertex in the result. Vertices that stay where they were given keep all their bits, which the frame
  /// need not hold: beside large coordinates it rounds those that are nearly 0.
  [[nodiscard]] Vec3f written(std::uint32_t vertex, const Vec3d& place) const {
    return place == frame.local(given[vertex]) ? given[vertex] : frame.world(place);
  }
  /// The place nearest to this that can be written.
  [[nodiscard]] Vec3d rounded(std::uint32_t vertex, const Vec3d& place) const {
    return place == frame.local(given[vertex]) ? place : frame.local(frame.world(place));
  }
};

/// The surface before it was decimated.
struct GivenSurface {
  std::vector<Vec3d> positions;
  Buffer<Triangle> faces;
};

}  // namespace pdc::detail
