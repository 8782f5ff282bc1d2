// How far the creases of a mesh are from another mesh that stands for it, such as what `pdc mesh` makes of it.
// usage: mesh_creases GIVEN RESULT VOXEL; prints the RMS distance in voxels of points along edges of GIVEN with
// dihedral angles above 20 degrees, three voxels and more from corners and from other creases, and how many points
// those are

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mesh/faces.h"
#include "mesh/nearest_triangles.h"
#include "mesh/point_triangle.h"
#include "mesh/winding/closed_surface.h"
#include "pdc/io/mesh/mesh_reader.h"

namespace {

using pdc::Mesh;
using pdc::Vec3d;

const double kSharp = std::cos(20 * std::numbers::pi / 180);
constexpr double kApart = 3;  // voxels

/// An edge between two faces that turn sharply.
struct Crease {
  std::array<std::uint32_t, 2> ends;
  std::array<Vec3d, 2> points;
  std::size_t chain = 0;
};

std::vector<Crease> findCreases(const pdc::detail::ClosedSurface& surface) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Vec3d>> normals;
  for (std::size_t i = 0; i < surface.own; ++i) {
    const auto p = surface.points(i);
    const Vec3d n = cross(p[1] - p[0], p[2] - p[0]);
    if (!(length(n) > 0)) continue;
    const pdc::Triangle& t = surface.surface.triangles[i];
    for (int k = 0; k < 3; ++k) normals[std::minmax(t[k], t[(k + 1) % 3])].push_back(n * (1 / length(n)));
  }
  std::vector<Crease> creases;
  const auto at = [&](std::uint32_t v) { return pdc::vecCast<double>(surface.surface.positions[v]); };
  for (const auto& [e, n] : normals)
    if (n.size() == 2 && dot(n[0], n[1]) < kSharp)
      creases.push_back({{e.first, e.second}, {at(e.first), at(e.second)}});
  return creases;
}

/// Where creases end, meet or turn sharply.
std::vector<Vec3d> findCorners(std::vector<Crease>& creases) {
  std::map<std::uint32_t, std::vector<std::size_t>> around;
  for (std::size_t i = 0; i < creases.size(); ++i)
    for (const std::uint32_t v : creases[i].ends) around[v].push_back(i);
  std::vector<std::size_t> next(creases.size());
  for (std::size_t i = 0; i < next.size(); ++i) next[i] = i;
  const auto root = [&](std::size_t i) {
    while (next[i] != i) i = next[i] = next[next[i]];
    return i;
  };
  std::vector<Vec3d> corners;
  for (const auto& [vertex, edges] : around) {
    const auto away = [&](std::size_t edge) {
      const Crease& c = creases[edge];
      const Vec3d d = (c.points[1] - c.points[0]) * (c.ends[0] == vertex ? 1 : -1);
      return d * (1 / length(d));
    };
    if (edges.size() == 2 && dot(away(edges[0]), away(edges[1])) < -kSharp) {
      next[root(edges[0])] = root(edges[1]);
      continue;
    }
    const Crease& c = creases[edges[0]];
    corners.push_back(c.points[c.ends[0] == vertex ? 0 : 1]);
  }
  for (std::size_t i = 0; i < creases.size(); ++i) creases[i].chain = root(i);
  return corners;
}

void run(const std::string& given, const std::string& result, double voxel) {
  const Mesh mesh = pdc::readMesh(given), made = pdc::readMesh(result);
  std::vector<Crease> creases = findCreases(pdc::detail::closeSurface(mesh));
  const std::vector<Vec3d> corners = findCorners(creases);
  const pdc::detail::NearestTriangles nearest(made);
  const double apart = kApart * kApart * voxel * voxel;
  const auto alone = [&](const Vec3d& p, const Crease& own) {
    return std::none_of(corners.begin(), corners.end(), [&](const Vec3d& c) { return dot(p - c, p - c) < apart; }) &&
           std::none_of(creases.begin(), creases.end(), [&](const Crease& c) {
             return c.chain != own.chain && pdc::detail::squaredToSegment(p, c.points[0], c.points[1]) < apart;
           });
  };
  double sum = 0;
  std::size_t count = 0;
  for (const Crease& c : creases) {
    const Vec3d along = c.points[1] - c.points[0];
    const auto steps = static_cast<int>(std::ceil(2 * length(along) / voxel));
    for (int i = 0; i < steps; ++i) {
      const Vec3d p = c.points[0] + along * ((i + 0.5) / steps);
      if (!alone(p, c)) continue;
      sum += nearest.find(p + mesh.origin - made.origin).squared;
      ++count;
    }
  }
  if (count == 0) {
    fmt::print("- 0\n");
  } else {
    fmt::print("{:.4f} {}\n", std::sqrt(sum / static_cast<double>(count)) / voxel, count);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 4) throw std::invalid_argument("usage: mesh_creases GIVEN RESULT VOXEL");
    run(argv[1], argv[2], std::atof(argv[3]));
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "mesh_creases: {}\n", error.what());
    return 1;
  }
}
