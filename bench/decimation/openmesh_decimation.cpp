#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "best_rates.h"
#include "decimation/decimation_peers.h"

namespace pdc::eval {
namespace {

using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<>;

OpenMeshMesh toOpenMesh(const Mesh& mesh) {
  OpenMeshMesh out;
  out.request_face_normals();
  const std::size_t faces = mesh.triangles.size();
  out.reserve(mesh.positions.size(), faces + faces / 2, faces);
  for (const Vec3f& p : mesh.positions) out.add_vertex({p.x, p.y, p.z});
  for (const Triangle& t : mesh.triangles) {
    const auto vertex = [&](int i) { return out.vertex_handle(t[i]); };
    if (!out.add_face(vertex(0), vertex(1), vertex(2)).is_valid()) throw CannotHold("not manifold");
  }
  out.update_face_normals();
  return out;
}

Mesh fromOpenMesh(OpenMeshMesh& mesh) {
  mesh.garbage_collection();
  Mesh out;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    out.positions.push_back({p[0], p[1], p[2]});
  }
  for (const auto f : mesh.faces()) {
    Triangle t{};
    int i = 0;
    for (const auto v : mesh.fv_range(f)) t[i++] = static_cast<std::uint32_t>(v.idx());
    out.triangles.push_back(t);
  }
  return out;
}

}  // namespace

Decimated openMeshQuadrics(const Mesh& mesh, std::size_t targetFaces) {
  using Decimater = OpenMesh::Decimater::DecimaterT<OpenMeshMesh>;
  OpenMeshMesh work = toOpenMesh(mesh);
  work.request_vertex_status();
  work.request_edge_status();
  work.request_halfedge_status();
  work.request_face_status();
  const double start = bench::threadSeconds();
  {
    Decimater decimater(work);
    OpenMesh::Decimater::ModQuadricT<OpenMeshMesh>::Handle quadrics;
    OpenMesh::Decimater::ModNormalFlippingT<OpenMeshMesh>::Handle flipping;
    decimater.add(quadrics);
    decimater.add(flipping);
    decimater.module(quadrics).unset_max_err();  // The quadrics decide the order, at any error.
    decimater.initialize();
    decimater.decimate_to_faces(0, targetFaces);
  }
  const double seconds = bench::threadSeconds() - start;
  return {fromOpenMesh(work), seconds};
}

}  // namespace pdc::eval
