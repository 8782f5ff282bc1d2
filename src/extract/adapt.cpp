#include "extract/adapt.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "pdc/mesh/distance.h"
#include "pdc/simplify/decimate.h"

namespace pdc::detail {
namespace {

struct PlaceHash {
  std::size_t operator()(const Vec3f& p) const {
    std::uint64_t h = 0;
    for (const float x : {p.x, p.y, p.z})
      h = (h ^ std::bit_cast<std::uint32_t>(x == 0 ? 0.0F : x)) * 0x9E3779B97F4A7C15u;
    return static_cast<std::size_t>(h ^ h >> 32);
  }
};

/// Names a triangle by its lowest corner first, so that it is found whichever corner a face begins with.
Triangle rotated(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// Makes quads of those pairs of a mesh's triangles that were one before. Vertices that stay keep their places to the
/// last bit, by which they are found.
void restoreQuads(const Mesh& full, Mesh& mesh) {
  std::unordered_map<Vec3f, std::uint32_t, PlaceHash> vertexAt;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) vertexAt.emplace(mesh.positions[v], v);
  std::vector<Triangle> sorted;
  for (const Triangle& t : mesh.triangles) sorted.push_back(rotated(t));
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint8_t> used(sorted.size(), 0);
  const auto find = [&](const Triangle& t) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), rotated(t));
    return at != sorted.end() && *at == rotated(t) ? static_cast<std::size_t>(at - sorted.begin()) : sorted.size();
  };
  for (const Quad& q : full.quads) {
    Quad now{};
    bool stays = true;
    for (int k = 0; k < 4 && stays; ++k) {
      const auto at = vertexAt.find(full.positions[q[k]]);
      stays = at != vertexAt.end();
      if (stays) now[k] = at->second;
    }
    if (!stays) continue;
    const std::size_t first = find({now[0], now[1], now[2]}), second = find({now[0], now[2], now[3]});
    if (first == sorted.size() || second == sorted.size() || used[first] != 0 || used[second] != 0) continue;
    used[first] = used[second] = 1;
    mesh.quads.push_back(now);
  }
  std::size_t kept = 0;
  for (const Triangle& t : mesh.triangles)
    if (used[find(t)] == 0) mesh.triangles[kept++] = t;
  mesh.triangles.resize(kept);
}

double farthest(const Mesh& from, const Mesh& to, const Monitor& monitor) {
  double most = 0;
  for (const double d : vertexDistances(from, to, monitor)) most = std::max(most, d);
  return most;
}

}  // namespace

Adapted adapt(const Mesh& full, double distance, double step, bool triangles, const Monitor& monitor) {
  DecimateReport report;
  Adapted adapted;
  adapted.mesh = decimate(full, {.error = MeshLength(distance), .sound = true, .positionStep = step}, &report, monitor);
  adapted.trianglesBefore = report.facesBefore;
  if (adapted.mesh.empty()) return adapted;
  const Monitor quiet{.progress = {}, .stop = monitor.stop};
  adapted.distance = std::max(farthest(adapted.mesh, full, quiet), farthest(full, adapted.mesh, quiet));
  if (!triangles) restoreQuads(full, adapted.mesh);
  return adapted;
}

}  // namespace pdc::detail
