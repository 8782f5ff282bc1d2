#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <stdexcept>

#include "smoothing/smoothing_peers.h"

namespace pdc::eval {

Mesh openMeshLaplacian(const Mesh& mesh, int iterations) {
  using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<>;
  OpenMeshMesh work;
  for (const Vec3f& p : mesh.positions) work.add_vertex({p.x, p.y, p.z});
  for (const Triangle& t : mesh.triangles) {
    const auto vertex = [&](int i) { return work.vertex_handle(t[i]); };
    if (!work.add_face(vertex(0), vertex(1), vertex(2)).is_valid()) throw std::runtime_error("not manifold");
  }
  work.request_face_normals();
  work.request_vertex_normals();
  work.request_vertex_status();
  work.update_normals();
  using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<OpenMeshMesh>;
  Smoother smoother(work);
  smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
  smoother.smooth(static_cast<unsigned>(iterations));
  Mesh out = mesh;
  for (std::size_t v = 0; v < out.positions.size(); ++v) {
    const auto& p = work.point(work.vertex_handle(static_cast<unsigned>(v)));
    out.positions[v] = {p[0], p[1], p[2]};
  }
  return out;
}

}  // namespace pdc::eval
