#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_probabilistic_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cmath>
#include <utility>

#include "best_rates.h"
#include "decimation/decimation_peers.h"

namespace pdc::eval {
namespace {

namespace Simplification = CGAL::Surface_mesh_simplification;

using Kernel = CGAL::Simple_cartesian<double>;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

CgalMesh toCgal(const Mesh& mesh) {
  CgalMesh out;
  const auto faces = static_cast<unsigned>(mesh.triangles.size());
  out.reserve(static_cast<unsigned>(mesh.positions.size()), faces + faces / 2, faces);
  for (const Vec3f& p : mesh.positions) out.add_vertex({p.x, p.y, p.z});
  using Vertex = CgalMesh::Vertex_index;
  for (const Triangle& t : mesh.triangles)
    if (out.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == CgalMesh::null_face())
      throw CannotHold("not manifold");
  return out;
}

Mesh fromCgal(CgalMesh& mesh) {
  mesh.collect_garbage();
  Mesh out;
  for (const auto v : mesh.vertices()) {
    const Kernel::Point_3& p = mesh.point(v);
    out.positions.push_back(vecCast<float>(Vec3d{p.x(), p.y(), p.z()}));
  }
  for (const auto f : mesh.faces()) {
    Triangle t{};
    int i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[i++] = v;
    out.triangles.push_back(t);
  }
  return out;
}

/// CGAL 5.5 counts edges, which is not the same for surfaces with a boundary.
struct StopAtFaces {
  std::size_t faces;

  template <typename Cost, typename Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    return profile.surface_mesh().number_of_faces() <= faces;
  }
};

/// \param run collapses edges of the CGAL mesh until StopAtFaces says so.
template <typename Run>
Decimated timed(const Mesh& mesh, Run&& run) {
  CgalMesh work = toCgal(mesh);
  const double start = bench::threadSeconds();
  run(work);
  const double seconds = bench::threadSeconds() - start;
  return {fromCgal(work), seconds};
}

template <typename Policies>
void collapse(CgalMesh& mesh, const Policies& policies, std::size_t targetFaces) {
  const Simplification::Bounded_normal_change_placement<Policies> placement(policies);
  Simplification::edge_collapse(mesh, StopAtFaces{targetFaces},
                                CGAL::parameters::get_cost(policies).get_placement(placement));
}

double meanEdgeLength(const CgalMesh& mesh) {
  double sum = 0;
  for (const auto e : mesh.edges())
    sum += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  return sum / static_cast<double>(mesh.number_of_edges());
}

}  // namespace

Decimated cgalPlanes(const Mesh& mesh, std::size_t targetFaces) {
  return timed(mesh, [&](CgalMesh& work) {
    const Simplification::GarlandHeckbert_plane_policies<CgalMesh, Kernel> policies(work);
    collapse(work, policies, targetFaces);
  });
}

Decimated cgalProbabilisticPlanes(const Mesh& mesh, std::size_t targetFaces) {
  return timed(mesh, [&](CgalMesh& work) {
    constexpr double kVariance = 0.05 * 0.05, kBoundaryWeight = 100;  // The weight is CGAL's default.
    const double l = meanEdgeLength(work);
    const CGAL::Constant_property_map<CgalMesh::Face_index, std::pair<double, double>> variances(
        {kVariance, kVariance * l * l});
    const Simplification::GarlandHeckbert_probabilistic_plane_policies<CgalMesh, Kernel> policies(work, kBoundaryWeight,
                                                                                                  variances);
    collapse(work, policies, targetFaces);
  });
}

Decimated cgalLindstromTurk(const Mesh& mesh, std::size_t targetFaces) {
  return timed(mesh, [&](CgalMesh& work) {
    const Simplification::LindstromTurk_cost<CgalMesh> cost;
    const Simplification::LindstromTurk_placement<CgalMesh> placement;
    Simplification::edge_collapse(work, StopAtFaces{targetFaces},
                                  CGAL::parameters::get_cost(cost).get_placement(placement));
  });
}

}  // namespace pdc::eval
