#pragma once

#include <array>
#include <cstddef>

#include "pdc/mesh/mesh.h"

namespace pdc::test {

/// Adds a cube whose faces point outwards, its bottom first and its top last.
inline void addCube(Mesh& mesh, const Vec3f& low, float side) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(low + Vec3f{side * static_cast<float>(i & 1), side * static_cast<float>(i >> 1 & 1),
                                         side * static_cast<float>(i >> 2)});
  constexpr std::array<Quad, 6> kFaces{Quad{0, 2, 3, 1}, {0, 1, 5, 4}, {1, 3, 7, 5},
                                       {3, 2, 6, 7},     {2, 0, 4, 6}, {4, 5, 7, 6}};
  for (const Quad& q : kFaces) {
    mesh.triangles.push_back({first + q[0], first + q[1], first + q[2]});
    mesh.triangles.push_back({first + q[0], first + q[2], first + q[3]});
  }
}

/// The unit cube at the origin.
inline Mesh cube() {
  Mesh mesh;
  addCube(mesh, {0, 0, 0}, 1);
  return mesh;
}

inline Mesh insideOut(Mesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// The unit cube without its top.
inline Mesh openCube() {
  Mesh mesh = cube();
  mesh.triangles.resize(10);
  return mesh;
}

}  // namespace pdc::test
