#include "mesh/local/vertex_normals.h"

#include <vector>

#include "mesh/faces.h"

namespace pdc::detail {

Buffer<Vec3f> vertexNormals(const Mesh& mesh) {
  std::vector<Vec3d> sums(mesh.positions.size(), Vec3d{});
  for (std::size_t i = 0; i < triangleCount(mesh); ++i) {
    const Triangle t = triangle(mesh, i);
    const Vec3d p = vecCast<double>(mesh.positions[t[0]]);
    const Vec3d n = cross(vecCast<double>(mesh.positions[t[1]]) - p, vecCast<double>(mesh.positions[t[2]]) - p);
    for (const std::uint32_t v : t) sums[v] += n;
  }
  Buffer<Vec3f> normals(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double l = length(sums[v]);
    normals[v] = vecCast<float>(l > 0 ? sums[v] * (1 / l) : Vec3d{});
  }
  return normals;
}

}  // namespace pdc::detail
