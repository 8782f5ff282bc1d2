#include "pdc/mesh/triangulate_polygons.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "mesh/mesh_checks.h"
#include "mesh/polygons/ear_clipping.h"

namespace pdc {

void triangulatePolygons(Mesh& mesh) {
  detail::checkSizes(mesh, "triangulatePolygons", detail::FaceKinds::kAll);
  const Polygons& polygons = mesh.polygons;
  if (polygons.empty()) return;
  detail::checkIndices(mesh);
  // Each polygon makes two triangles less than it has corners, so those before it tell where its own begin.
  const std::size_t before = mesh.triangles.size();
  mesh.triangles.resize(before + polygons.corners.size() - 2 * polygons.size());
  tbb::enumerable_thread_specific<detail::EarClipper> clippers;
  tbb::parallel_for(std::size_t{0}, polygons.size(), [&](std::size_t i) {
    clippers.local().triangulate(polygons[i], mesh.positions,
                                 mesh.triangles.data() + before + polygons.starts[i] - 2 * i);
  });
  mesh.polygons = {};
}

}  // namespace pdc
