#include "pdc/mesh/triangulate_polygons.h"

#include <tbb/parallel_for.h>

#include "mesh/mesh_checks.h"

namespace pdc {

void triangulatePolygons(Mesh& mesh) {
  detail::checkSizes(mesh, "triangulatePolygons", detail::FaceKinds::kAll);
  const Polygons& polygons = mesh.polygons;
  if (polygons.empty()) return;
  // Each polygon makes two triangles less than it has corners, so those before it tell where its own begin.
  const std::size_t before = mesh.triangles.size();
  mesh.triangles.resize(before + polygons.corners.size() - 2 * polygons.size());
  tbb::parallel_for(std::size_t{0}, polygons.size(), [&](std::size_t i) {
    const auto polygon = polygons[i];
    Triangle* out = mesh.triangles.data() + before + polygons.starts[i] - 2 * i;
    for (std::size_t k = 2; k < polygon.size(); ++k) *out++ = {polygon[0], polygon[k - 1], polygon[k]};
  });
  mesh.polygons = {};
}

}  // namespace pdc
