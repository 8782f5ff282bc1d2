#include "render/view_mesh.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"

namespace pdc::detail {
namespace {

/// The triangles around each vertex: those of vertex v are around[first[v]] to around[first[v + 1] - 1], ascending.
struct Stars {
  Buffer<std::uint32_t> first, around;

  Stars(std::span<const Triangle> triangles, std::size_t vertices)
      : first(vertices + 2, 0), around(3 * triangles.size()) {
    // Triangles are counted two places on, so that filling leaves each start where it belongs.
    for (const Triangle& t : triangles)
      for (const std::uint32_t v : t) ++first[v + 2];
    for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (const std::uint32_t v : triangles[i]) around[first[v + 1]++] = static_cast<std::uint32_t>(i);
  }
};

/// Triangles at one vertex whose normals are much alike: that of the first, and the sum of all, weighted by area.
struct Facet {
  Vec3f normal, sum{};
};

/// More triangles than this at a vertex are gathered into facets. Else time would grow with their square.
constexpr std::uint32_t kManyAround = 256;

/// The facets of each vertex with many triangles.
std::map<std::uint32_t, std::vector<Facet>> facetsAtHubs(const Stars& stars, std::span<const Vec3f> faceNormals,
                                                         std::span<const float> areas) {
  constexpr float kSteps = 32;  // of a coordinate of the normal, from 0 to 1
  std::map<std::uint32_t, std::vector<Facet>> result;
  for (std::uint32_t v = 0; v + 2 < stars.first.size(); ++v) {
    if (stars.first[v + 1] - stars.first[v] <= kManyAround) continue;
    std::map<std::array<int, 3>, Facet> facets;
    for (std::uint32_t s = stars.first[v]; s < stars.first[v + 1]; ++s) {
      const Vec3f& n = faceNormals[stars.around[s]];
      const auto step = [](float x) { return static_cast<int>(std::round(x * kSteps)); };
      Facet& facet = facets.try_emplace({step(n.x), step(n.y), step(n.z)}, Facet{n}).first->second;
      facet.sum += n * areas[stars.around[s]];
    }
    for (const auto& [place, facet] : facets) result[v].push_back(facet);
  }
  return result;
}

}  // namespace

Buffer<std::array<Vec3f, 3>> smoothNormals(std::span<const Triangle> triangles, std::span<const Vec3f> faceNormals,
                                           std::span<const float> areas, std::size_t vertexCount) {
  const auto least = static_cast<float>(std::cos(kCreaseDegrees * std::numbers::pi / 180));
  const Stars stars(triangles, vertexCount);
  const auto hubs = facetsAtHubs(stars, faceNormals, areas);
  Buffer<std::array<Vec3f, 3>> normals(triangles.size());
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t i) {
    const Vec3f own = faceNormals[i];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = triangles[i][k];
      Vec3f sum{};
      if (stars.first[v + 1] - stars.first[v] > kManyAround) {
        for (const Facet& facet : hubs.at(v))
          if (dot(own, facet.normal) >= least) sum += facet.sum;
      } else {
        for (std::uint32_t s = stars.first[v]; s < stars.first[v + 1]; ++s) {
          const std::uint32_t j = stars.around[s];
          if (dot(own, faceNormals[j]) >= least) sum += faceNormals[j] * areas[j];
        }
      }
      // All summed normals are within the angle of the face's own, so only sums without area vanish.
      const float l = length(sum);
      normals[i][k] = l > 0 ? sum * (1 / l) : own;
    }
  });
  return normals;
}

ViewMesh viewMesh(const Mesh& mesh, const Camera& camera, int width, int height) {
  checkIndices(mesh);
  ViewMesh view;
  view.positions.resize(mesh.positions.size() + 1);
  view.positions.back() = {};
  const Vec3d offset = mesh.origin - camera.center;
  const Vec3d middle{0.5 * width, 0.5 * height, 0};
  tbb::parallel_for(std::size_t{0}, mesh.positions.size(), [&](std::size_t i) {
    const Vec3d p = vecCast<double>(mesh.positions[i]) + offset;
    view.positions[i] = vecCast<float>(middle + camera.axes * p * camera.pixelsPerUnit);
  });

  const std::size_t all = triangleCount(mesh);
  view.triangles.reserve(all);
  view.faceNormals.reserve(all);
  view.drawnEdges.reserve(all);
  Buffer<float> areas;
  areas.reserve(all);
  for (std::size_t i = 0; i < all; ++i) {
    const Triangle t = triangle(mesh, i);
    const Vec3d a = vecCast<double>(view.positions[t[0]]);
    const Vec3d n = cross(vecCast<double>(view.positions[t[1]]) - a, vecCast<double>(view.positions[t[2]]) - a);
    const double l = length(n);
    if (!(l > 0) || !std::isfinite(l)) continue;
    view.triangles.push_back(t);
    view.faceNormals.push_back(vecCast<float>(n * (1 / l)));
    areas.push_back(static_cast<float>(l));
    // The diagonal of a quad lies opposite the second corner of its first half and the third of the other.
    const bool half = i < 2 * mesh.quads.size();
    view.drawnEdges.push_back(!half ? 0b111 : i % 2 == 0 ? 0b101 : 0b011);
  }
  view.cornerNormals = smoothNormals(view.triangles, view.faceNormals, areas, mesh.positions.size());
  return view;
}

}  // namespace pdc::detail
