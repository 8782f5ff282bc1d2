#include "simplify/decimation/intersecting_faces.h"

#include "pdc/mesh/self_intersections.h"

namespace pdc::detail {

FacePairs intersectingFaces(const DecimatedSurface& surface, std::span<const Vec3d> positions,
                            std::span<const Triangle> faces, const Monitor& monitor) {
  Mesh mesh;
  mesh.positions.reserve(positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) mesh.positions.push_back(surface.written(v, positions[v]));
  mesh.triangles.assign(faces.begin(), faces.end());
  return selfIntersections(mesh, {}, {.progress = {}, .stop = monitor.stop}).pairs;
}

}  // namespace pdc::detail
