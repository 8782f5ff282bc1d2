#pragma once

#include <array>
#include <cstdint>

#include "pdc/math/vec3.h"
#include "pdc/mesh/buffer.h"

namespace pdc {

using Quad = std::array<std::uint32_t, 4>;
using Triangle = std::array<std::uint32_t, 3>;

/// An indexed surface: vertices, and quads or triangles or both.
///
/// Positions are world coordinates. Faces are counter-clockwise seen from outside. A quad (v0, v1, v2, v3) stands for
/// the triangles (v0, v1, v2) and (v0, v2, v3): its first corner fixes the diagonal.
struct Mesh {
  Buffer<Vec3f> positions;
  Buffer<Vec3f> normals;       ///< Empty, or one unit vector per vertex.
  Buffer<float> confidence;    ///< Empty, or one number in [0, 1] per vertex; see ContourOptions.
  Buffer<std::uint8_t> ranks;  ///< Empty, or one per vertex: 1 on a flat part, 2 on an edge, 3 at a corner.
  Buffer<Quad> quads;
  Buffer<Triangle> triangles;

  [[nodiscard]] bool empty() const { return quads.empty() && triangles.empty(); }
};

}  // namespace pdc
