#include "extract/adapt.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "pdc/error.h"
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

/// The property that decimation takes scales from. No vertex of a contour has another of that name.
constexpr const char* kScaleName = "adaptive scale";

/// Lowers what vertices have to the least of their neighbours'.
void takeLeast(const Mesh& mesh, Buffer<float>& scales) {
  const Buffer<float> own = scales;
  const auto lower = [&](const auto& face) {
    float least = own[face[0]];
    for (const std::uint32_t v : face) least = std::min(least, own[v]);
    for (const std::uint32_t v : face) scales[v] = std::min(scales[v], least);
  };
  for (const Quad& q : mesh.quads) lower(q);
  for (const Triangle& t : mesh.triangles) lower(t);
}

/// What a scale is at each vertex and its neighbours, the least of it.
Buffer<float> leastScales(const Mesh& mesh, const std::function<double(const Vec3d&)>& scale, const Monitor& monitor) {
  Buffer<float> scales(mesh.positions.size());
  const auto place = [&](std::size_t v) { return mesh.origin + vecCast<double>(mesh.positions[v]); };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scales.size(), 1024), [&](const auto& r) {
    if (monitor.stopped()) return;
    for (std::size_t v = r.begin(); v < r.end(); ++v) scales[v] = static_cast<float>(scale(place(v)));
  });
  monitor.throwIfStopped();
  for (std::size_t v = 0; v < scales.size(); ++v) {
    if (scales[v] >= 0 && std::isfinite(scales[v])) continue;
    const Vec3d p = place(v);
    throw Error(fmt::format("the adaptive scale at ({:.6g}, {:.6g}, {:.6g}) is {}; the limit is a finite number >= 0",
                            p.x, p.y, p.z, scales[v]));
  }
  takeLeast(mesh, scales);
  return scales;
}

double farthest(const Mesh& from, const Mesh& to, const Monitor& monitor) {
  double most = 0;
  for (const double d : vertexDistances(from, to, monitor)) most = std::max(most, d);
  return most;
}

}  // namespace

Adapted adapt(Mesh& full, const ContourOptions& options, double step, const Monitor& monitor) {
  DecimateReport report;
  Adapted adapted;
  DecimateOptions decimation{.error = MeshLength(*options.adaptive), .sound = true, .positionStep = step};
  if (options.adaptiveScale) {
    decimation.errorScale = kScaleName;
    full.properties.push_back({kScaleName, 1, leastScales(full, options.adaptiveScale, monitor)});
  }
  adapted.mesh = decimate(full, decimation, &report, monitor);
  if (options.adaptiveScale)
    for (Mesh* const mesh : {&full, &adapted.mesh}) mesh->properties.pop_back();
  adapted.trianglesBefore = report.facesBefore;
  if (adapted.mesh.empty()) return adapted;
  const Monitor quiet{.progress = {}, .stop = monitor.stop};
  adapted.distance = std::max(farthest(adapted.mesh, full, quiet), farthest(full, adapted.mesh, quiet));
  if (!options.triangles) restoreQuads(full, adapted.mesh);
  return adapted;
}

}  // namespace pdc::detail
