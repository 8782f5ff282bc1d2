// Surfaces of noisy points of a torus whose distance is known: pdc's beside CGAL's advancing front and CGAL's Poisson
// reconstruction, which gets the true normals. Prints the table of docs/reconstruction.md. Usage: reconstruct_eval
// [POINTS]
#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/poisson_surface_reconstruction.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "parallel/stopwatch.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/points/reconstruct.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

constexpr double kLarge = 1, kSmall = 0.35, kNoise = 0.004;

double distance(const pdc::Vec3d& p) { return std::hypot(std::hypot(p.x, p.y) - kLarge, p.z) - kSmall; }

/// Evenly spread points with noise; `normals` become the true ones.
pdc::PointCloud torusPoints(std::size_t n, std::vector<pdc::Vec3d>& normals) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> noise(0, kNoise);
  pdc::PointCloud cloud;
  while (cloud.positions.size() < n) {
    const double u = 2 * std::numbers::pi * uniform(random), v = 2 * std::numbers::pi * uniform(random);
    if (uniform(random) * (kLarge + kSmall) > kLarge + kSmall * std::cos(v)) continue;
    const pdc::Vec3d normal{std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)};
    const pdc::Vec3d centre{kLarge * std::cos(u), kLarge * std::sin(u), 0};
    cloud.positions.push_back(centre + normal * kSmall + pdc::Vec3d{noise(random), noise(random), noise(random)});
    normals.push_back(normal);
  }
  return cloud;
}

void print(const std::string& name, const pdc::Mesh& mesh, double seconds) {
  const pdc::MeshReport facts = pdc::analyze(mesh);
  double sum = 0, most = 0;
  for (const pdc::Vec3f& p : mesh.positions) {
    const double d = std::abs(distance(pdc::vecCast<double>(p)));
    sum += d * d;
    most = std::max(most, d);
  }
  fmt::print("| {} | {:.5f} | {:.4f} | {} | {} | {} | {:.1f} |\n", name,
             std::sqrt(sum / static_cast<double>(mesh.positions.size())), most, facts.triangles, facts.boundaryEdges,
             facts.eulerNumber, seconds);
  std::fflush(stdout);
}

pdc::Mesh advancingFront(const std::vector<Point>& points) {
  std::vector<std::array<std::size_t, 3>> faces;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(), std::back_inserter(faces));
  pdc::Mesh mesh;
  for (const Point& p : points)
    mesh.positions.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  for (const auto& f : faces) mesh.triangles.push_back({std::uint32_t(f[0]), std::uint32_t(f[1]), std::uint32_t(f[2])});
  return mesh;
}

pdc::Mesh poisson(const std::vector<Point>& points, const std::vector<pdc::Vec3d>& normals, double spacing) {
  std::vector<std::pair<Point, Kernel::Vector_3>> oriented;
  for (std::size_t i = 0; i < points.size(); ++i)
    oriented.emplace_back(points[i], Kernel::Vector_3(normals[i].x, normals[i].y, normals[i].z));
  using Pair = std::pair<Point, Kernel::Vector_3>;
  CGAL::Surface_mesh<Point> surface;
  pdc::Mesh mesh;
  if (!CGAL::poisson_surface_reconstruction_delaunay(oriented.begin(), oriented.end(),
                                                     CGAL::First_of_pair_property_map<Pair>(),
                                                     CGAL::Second_of_pair_property_map<Pair>(), surface, spacing))
    return mesh;
  for (const auto v : surface.vertices()) {
    const Point& p = surface.point(v);
    mesh.positions.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  for (const auto f : surface.faces()) {
    pdc::Triangle t{};
    std::size_t k = 0;
    for (const auto v : vertices_around_face(surface.halfedge(f), surface)) t[k++] = static_cast<std::uint32_t>(v);
    mesh.triangles.push_back(t);
  }
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t n = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 100000;
  std::vector<pdc::Vec3d> normals;
  const pdc::PointCloud cloud = torusPoints(n, normals);
  fmt::print("{} points with noise {}\n\n", n, kNoise);
  fmt::print(
      "| method | RMS distance | largest | triangles | boundary edges | Euler | s |\n|---|---|---|---|---|---|---|\n");
  pdc::detail::Stopwatch stopwatch;
  pdc::ReconstructReport report;
  const pdc::Mesh surface = pdc::reconstruct(cloud, {}, &report);
  print(fmt::format("pdc, {} Gaussians", report.gaussians), surface, stopwatch.lap());
  const double voxel = 2 * report.mixture.sigma0;
  const pdc::Mesh contoured = pdc::reconstruct(cloud, {.voxelSize = voxel});
  print(fmt::format("pdc, voxels of {:.4f}", voxel), contoured, stopwatch.lap());
  std::vector<Point> points;
  for (const pdc::Vec3d& p : cloud.positions) points.emplace_back(p.x, p.y, p.z);
  const pdc::Mesh front = advancingFront(points);
  print("CGAL, advancing front", front, stopwatch.lap());
  const pdc::Mesh smooth = poisson(points, normals, report.mixture.sigma0);
  print("CGAL, Poisson with true normals", smooth, stopwatch.lap());
}
