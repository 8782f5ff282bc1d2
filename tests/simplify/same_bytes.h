#pragma once

#include <cstring>

#include "pdc/mesh/mesh.h"

namespace pdc::test {

/// Whether two meshes of triangles have the same faces, and positions equal to the last bit.
inline bool sameBytes(const Mesh& a, const Mesh& b) {
  return a.triangles == b.triangles && a.positions.size() == b.positions.size() &&
         std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * sizeof(Vec3f)) == 0;
}

}  // namespace pdc::test
