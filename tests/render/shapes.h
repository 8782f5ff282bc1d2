#pragma once

#include <cmath>
#include <numbers>

#include "pdc/mesh/mesh.h"

namespace pdc::test {

/// The box [-1, 1]³ as six quads.
inline Mesh cube() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({i & 1 ? 1.0F : -1.0F, i & 2 ? 1.0F : -1.0F, i & 4 ? 1.0F : -1.0F});
  mesh.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

/// The unit sphere: 2 n meridians and n parallels, as quads that touch in their poles.
inline Mesh sphere(int n) {
  Mesh mesh;
  const auto columns = static_cast<std::uint32_t>(2 * n), rows = static_cast<std::uint32_t>(n);
  for (std::uint32_t i = 0; i <= rows; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double a = std::numbers::pi * i / rows, b = 2 * std::numbers::pi * j / columns;
      mesh.positions.push_back(
          vecCast<float>(Vec3d{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)}));
    }
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const std::uint32_t k = (j + 1) % columns;
      mesh.quads.push_back({i * columns + j, (i + 1) * columns + j, (i + 1) * columns + k, i * columns + k});
    }
  return mesh;
}

/// The surface turned inside out.
inline Mesh insideOut(Mesh mesh) {
  for (Quad& q : mesh.quads) std::swap(q[1], q[3]);
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace pdc::test
