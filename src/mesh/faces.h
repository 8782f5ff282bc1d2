#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "mesh/triangle_pair.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

// All faces of a mesh under one number: the quads first, then the triangles, then the polygons.

inline std::size_t faceCount(const Mesh& mesh) {
  return mesh.quads.size() + mesh.triangles.size() + mesh.polygons.size();
}

inline std::span<const std::uint32_t> face(const Mesh& mesh, std::size_t i) {
  if (i < mesh.quads.size()) return mesh.quads[i];
  i -= mesh.quads.size();
  if (i < mesh.triangles.size()) return mesh.triangles[i];
  return mesh.polygons[i - mesh.triangles.size()];
}

// All triangles of a mesh without polygons under one number: the two of each quad first, then the others.

inline std::size_t triangleCount(const Mesh& mesh) { return 2 * mesh.quads.size() + mesh.triangles.size(); }

inline Triangle triangle(const Mesh& mesh, std::size_t i) {
  const std::size_t ofQuads = 2 * mesh.quads.size();
  if (i >= ofQuads) return mesh.triangles[i - ofQuads];
  const Quad& q = mesh.quads[i / 2];
  return {q[0], q[1 + i % 2], q[2 + i % 2]};
}

inline TriangleCorners corners(const Mesh& mesh, const Triangle& t) {
  return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

inline bool isFinite(const Vec3f& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace pdc::detail
