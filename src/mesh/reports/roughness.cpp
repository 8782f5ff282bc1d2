#include "pdc/mesh/roughness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/connectivity.h"
#include "mesh/faces.h"
#include "mesh/mesh_checks.h"

namespace pdc {
namespace {

/// Calls visit(triangle, its normal, as long as twice its area).
template <typename Visit>
void forEachNormal(const Mesh& mesh, Visit&& visit) {
  for (std::size_t i = 0; i < detail::triangleCount(mesh); ++i) {
    const Triangle t = detail::triangle(mesh, i);
    const Vec3d a = vecCast<double>(mesh.positions[t[0]]);
    visit(t, cross(vecCast<double>(mesh.positions[t[1]]) - a, vecCast<double>(mesh.positions[t[2]]) - a));
  }
}

std::vector<Vec3d> vertexNormals(const Mesh& mesh) {
  std::vector<Vec3d> normals(mesh.positions.size(), Vec3d{});
  forEachNormal(mesh, [&](const Triangle& t, const Vec3d& n) {
    for (const std::uint32_t v : t) normals[v] += n;
  });
  for (Vec3d& n : normals) n *= 1 / length(n);  // A vertex without one gets NaN.
  return normals;
}

}  // namespace

std::vector<std::uint8_t> flatVertices(const Mesh& mesh, double degrees) {
  detail::checkSizes(mesh, "flatVertices");
  detail::checkIndices(mesh);
  const double least = std::cos(degrees * std::numbers::pi / 180);
  const std::vector<Vec3d> normals = vertexNormals(mesh);
  std::vector<std::uint8_t> flat(normals.size());
  for (std::size_t v = 0; v < flat.size(); ++v) flat[v] = std::isfinite(dot(normals[v], normals[v]));
  forEachNormal(mesh, [&](const Triangle& t, const Vec3d& n) {
    for (const std::uint32_t v : t)
      if (!(dot(n, normals[v]) >= least * length(n))) flat[v] = 0;
  });
  return flat;
}

double roughness(const Mesh& mesh, const std::vector<std::uint8_t>& chosen) {
  detail::checkSizes(mesh, "roughness");
  detail::checkIndices(mesh);
  const std::vector<Vec3d> normals = vertexNormals(mesh);
  const detail::Connectivity connectivity(mesh);
  double squares = 0, used = 0;
  for (std::size_t v = 0; v < std::min(chosen.size(), normals.size()); ++v) {
    if (chosen[v] == 0) continue;
    // The next vertex of each face: around a vertex within the surface each neighbour is next once.
    Vec3d sum{};
    for (const detail::Corner& corner : connectivity.corners(v)) sum += vecCast<double>(mesh.positions[corner.next]);
    const double count = static_cast<double>(connectivity.corners(v).size());
    const double d = dot(normals[v], vecCast<double>(mesh.positions[v]) - sum * (1 / count));
    if (!std::isfinite(d)) continue;
    squares += d * d;
    used += 1;
  }
  return used > 0 ? std::sqrt(squares / used) : 0;
}

}  // namespace pdc
