#include <cmath>

#include "io/mesh/dialects.h"
#include "pdc/mesh/triangulate_polygons.h"

namespace pdc::test {
namespace {

/// The prism of height 1 over a polygon that is counter-clockwise seen from above.
Solid prism(const char* name, const std::vector<Vec3d>& outline, double area) {
  Solid solid{.name = name, .positions = outline, .faces = {}, .area = 2 * area, .volume = area};
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const Vec3d& p : outline) solid.positions.push_back({p.x, p.y, p.z + 1});
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    bottom.push_back(n - 1 - i);
    top.push_back(n + i);
    solid.faces.push_back({i, next, n + next, n + i});
    solid.area += length(outline[next] - outline[i]);
  }
  solid.faces.push_back(bottom);
  solid.faces.push_back(top);
  return solid;
}

}  // namespace

Mesh Solid::triangulated() const {
  Mesh mesh;
  for (const Vec3d& p : positions) mesh.positions.push_back(vecCast<float>(p));
  for (const auto& f : faces) mesh.polygons.add(f);
  triangulatePolygons(mesh);
  return mesh;
}

const std::vector<Solid>& solids() {
  static const std::vector<Solid> kSolids{
      {.name = "tetrahedron",
       .positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}},
       .faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
       .area = 24 + 8 * std::sqrt(3.0),
       .volume = 64.0 / 6},
      prism("cube", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1),
      prism("L", {{2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}, {2, 0, 0}}, 3),
      prism("arrow", {{3, 0, 0}, {0, 5, 0}, {-3, 0, 0}, {0, 2, 0}}, 9),
      prism("star", {{0, 0, 0}, {3, 2, 0}, {6, 0, 0}, {4, 3, 0}, {6, 6, 0}, {3, 4, 0}, {0, 6, 0}, {2, 3, 0}}, 12)};
  return kSolids;
}

}  // namespace pdc::test
