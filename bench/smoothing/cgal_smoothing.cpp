#include <CGAL/Polygon_mesh_processing/smooth_shape.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "smoothing/smoothing_peers.h"

namespace pdc::eval {

Mesh cgalCurvatureFlow(const Mesh& mesh, double time, int steps) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using Vertex = CgalMesh::Vertex_index;
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) sum += double{length(mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]])};
  const double unit = sum / (3 * static_cast<double>(mesh.triangles.size()));
  CgalMesh work;
  for (const Vec3f& p : mesh.positions) work.add_vertex({p.x / unit, p.y / unit, p.z / unit});
  for (const Triangle& t : mesh.triangles) work.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2]));
  namespace Processing = CGAL::Polygon_mesh_processing;
  Processing::smooth_shape(work, time / steps, Processing::parameters::number_of_iterations(steps));
  Mesh out = mesh;
  for (const auto v : work.vertices()) {
    const Kernel::Point_3& p = work.point(v);
    out.positions[v] = vecCast<float>(Vec3d{p.x(), p.y(), p.z()} * unit);
  }
  return out;
}

}  // namespace pdc::eval
