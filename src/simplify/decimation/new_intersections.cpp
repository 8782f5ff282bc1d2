#include "simplify/decimation/new_intersections.h"

#include <algorithm>

#include "pdc/mesh/self_intersections.h"

namespace pdc::detail {
namespace {

constexpr auto kNone = static_cast<std::uint32_t>(-1);

/// A surface after some collapses: its faces that are left, and for each the collapse that has changed it, or kNone.
struct Collapsed {
  std::vector<Vec3d> positions;
  std::vector<Triangle> faces;
  std::vector<std::uint32_t> changedBy;

  Collapsed(const DecimatedSurface& surface, const VertexStars& stars, std::span<const ChosenCollapse> collapses)
      : positions(surface.positions) {
    std::vector<Triangle> all(surface.faces.begin(), surface.faces.end());
    std::vector<std::uint32_t> owner(all.size(), kNone);
    for (std::uint32_t i = 0; i < collapses.size(); ++i) {
      const auto& [a, b, to] = collapses[i];
      positions[a] = to.place;
      for (const std::uint32_t v : {a, b})
        for (const StarCorner& c : stars[v]) owner[c.face] = i;
      for (const StarCorner& c : stars[b])
        for (std::uint32_t& v : all[c.face]) v = v == b ? a : v;
    }
    for (std::size_t f = 0; f < all.size(); ++f) {
      const auto& [u, v, w] = all[f];
      if (u == v || v == w || w == u) continue;
      faces.push_back(all[f]);
      changedBy.push_back(owner[f]);
    }
  }
};

}  // namespace

std::vector<std::array<std::uint32_t, 2>> intersectingFaces(const LocalFrame& frame, std::span<const Vec3d> positions,
                                                            std::span<const Triangle> faces, const Monitor& monitor) {
  Mesh mesh;
  mesh.positions.reserve(positions.size());
  for (const Vec3d& p : positions) mesh.positions.push_back(frame.world(p));
  mesh.triangles.assign(faces.begin(), faces.end());
  return selfIntersections(mesh, {}, {.progress = {}, .stop = monitor.stop}).pairs;
}

std::vector<ChosenCollapse> takeOutIntersecting(const DecimatedSurface& surface, const VertexStars& stars,
                                                std::vector<ChosenCollapse>& collapses, const Monitor& monitor) {
  std::vector<ChosenCollapse> out;
  while (!collapses.empty()) {
    const Collapsed after(surface, stars, collapses);
    std::vector<std::uint8_t> bad(collapses.size(), 0);
    for (const auto& pair : intersectingFaces(surface.frame, after.positions, after.faces, monitor))
      for (const std::uint32_t f : pair)
        if (after.changedBy[f] != kNone) bad[after.changedBy[f]] = 1;
    const std::size_t before = out.size();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < collapses.size(); ++i) {
      if (bad[i] != 0) {
        out.push_back(collapses[i]);
      } else {
        collapses[kept++] = collapses[i];
      }
    }
    collapses.resize(kept);
    if (out.size() == before) break;
  }
  return out;
}

}  // namespace pdc::detail
