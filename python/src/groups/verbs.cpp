#include <pybind11/stl.h>

#include <utility>

#include "convert.h"
#include "groups/groups.h"
#include "parallel/with_threads.h"
#include "pdc/mesh/triangulate_polygons.h"
#include "pdc/simplify/cluster.h"
#include "pdc/simplify/decimate.h"
#include "pdc/smooth/smooth.h"
#include "pdc/subdivide/subdivide.h"
#include "polite_run.h"

namespace pdc::python {
namespace {

using Json = nlohmann::ordered_json;
using Changed = std::pair<MeshHandle, py::object>;

template <typename Value>
using Words = std::vector<std::pair<std::string, Value>>;

const Words<QuadricKind> kQuadrics{{"plane", QuadricKind::kPlane},
                                   {"triangle", QuadricKind::kTriangle},
                                   {"probabilistic-plane", QuadricKind::kProbabilisticPlane},
                                   {"probabilistic-triangle", QuadricKind::kProbabilisticTriangle},
                                   {"point", QuadricKind::kPoint}};
const Words<CollapsePlacement> kPlacements{{"minimizer", CollapsePlacement::kMinimizer},
                                           {"subset", CollapsePlacement::kSubset}};
const Words<SubdivisionScheme> kSchemes{{"loop", SubdivisionScheme::kLoop},
                                        {"catmull-clark", SubdivisionScheme::kCatmullClark}};
const Words<LoopWeights> kWeights{{"loop", LoopWeights::kLoop}, {"warren", LoopWeights::kWarren}};
const Words<CovarianceSource> kCovariances{{"faces", CovarianceSource::kFaces},
                                           {"vertices", CovarianceSource::kVertices},
                                           {"normals", CovarianceSource::kNormals},
                                           {"properties", CovarianceSource::kProperties}};

/// Sets options by their names; None is what they are anyway.
class Setter {
 public:
  explicit Setter(const py::dict& options) : mOptions(options) {}

  template <typename Value, typename Target>
  void set(const char* name, Target& target) const {
    if (const py::object value = given(name); !value.is_none()) target = value.cast<Value>();
  }
  template <typename Value>
  void setWord(const char* name, const Words<Value>& words, Value& target) const {
    if (const py::object value = given(name); !value.is_none())
      target = valueOf(words, name, value.cast<std::string>());
  }
  [[nodiscard]] py::object given(const char* name) const {
    return mOptions.contains(name) ? py::object(mOptions[name]) : py::none();
  }
  [[nodiscard]] int threads() const {
    const py::object value = given("threads");
    return value.is_none() ? 0 : value.cast<int>();
  }

 private:
  const py::dict& mOptions;
};

/// Runs change(monitor) on so many threads.
template <typename Change>
MeshHandle changed(const py::object& progress, int threads, const Change& change) {
  return MeshHandle(makePolitely(
      progress, [&](const Monitor& monitor) { return detail::withThreads(threads, [&] { return change(monitor); }); }));
}

Changed decimated(const MeshHandle& mesh, const py::dict& given, const py::object& progress) {
  const Setter setter(given);
  DecimateOptions options;
  setter.set<std::size_t>("faces", options.faces);
  setter.set<double>("ratio", options.ratio);
  setter.set<double>("error", options.error);
  setter.set<double>("weld", options.weld);
  setter.setWord("quadric", kQuadrics, options.quadric);
  setter.setWord("placement", kPlacements, options.placement);
  setter.set<double>("sigma_normal", options.sigmaNormal);
  setter.set<double>("sigma_position", options.sigmaPosition);
  setter.set<std::string>("sigma_property", options.sigmaProperty);
  setter.set<double>("memory", options.memory);
  setter.set<double>("max_turn", options.maxTurn);
  setter.set<double>("boundary_weight", options.boundaryWeight);
  setter.set<bool>("lock_boundary", options.lockBoundary);
  setter.set<bool>("sound", options.sound);
  setter.set<bool>("fit", options.fit);
  setter.set<double>("pair_distance", options.pairDistance);
  DecimateReport r;
  MeshHandle result = changed(progress, setter.threads(),
                              [&](const Monitor& monitor) { return decimate(*mesh.mesh, options, &r, monitor); });
  return {std::move(result), toPython({{"faces_before", r.facesBefore},
                                       {"faces", r.facesAfter},
                                       {"vertices_before", r.verticesBefore},
                                       {"vertices", r.verticesAfter},
                                       {"welded_vertices", r.weldedVertices},
                                       {"mean_edge", r.meanEdge},
                                       {"noise", r.noise},
                                       {"sigma_n", r.sigmaNormal},
                                       {"sigma_p", r.sigmaPosition},
                                       {"memory", r.memory},
                                       {"error", options.error ? Json(r.error) : Json()},
                                       {"collapses", r.collapses},
                                       {"degenerate_faces", r.degenerateFaces},
                                       {"non_manifold_vertices", r.nonManifoldVertices}})};
}

Changed clustered(const MeshHandle& mesh, const py::dict& given, const py::object& progress) {
  const Setter setter(given);
  ClusterOptions options;
  setter.set<double>("cell", options.cell);
  setter.setWord("quadric", kQuadrics, options.quadric);
  setter.set<double>("sigma_normal", options.sigmaNormal);
  setter.set<double>("sigma_position", options.sigmaPosition);
  setter.set<double>("weld", options.weld);
  setter.set<bool>("free", options.free);
  setter.set<bool>("clean", options.clean);
  ClusterReport r;
  MeshHandle result = changed(progress, setter.threads(),
                              [&](const Monitor& monitor) { return cluster(*mesh.mesh, options, &r, monitor); });
  return {std::move(result), toPython({{"triangles_before", r.trianglesBefore},
                                       {"triangles", r.trianglesAfter},
                                       {"vertices", r.vertices},
                                       {"welded_vertices", r.weldedVertices},
                                       {"cells", r.cells},
                                       {"collapsed_triangles", r.collapsedTriangles},
                                       {"non_finite_triangles", r.nonFiniteTriangles},
                                       {"folded_faces", r.foldedFaces},
                                       {"duplicate_faces", r.duplicateFaces},
                                       {"outside_vertices", r.outsideVertices}})};
}

Changed smoothed(const MeshHandle& mesh, const py::dict& given, const py::object& progress) {
  const Setter setter(given);
  SmoothOptions options;
  setter.set<int>("iterations", options.iterations);
  setter.set<double>("sigma", options.sigma);
  setter.set<std::string>("sigma_property", options.sigmaProperty);
  setter.set<bool>("normalise_area", options.normaliseArea);
  setter.set<bool>("plain", options.plain);
  setter.set<bool>("lock_boundary", options.lockBoundary);
  SmoothReport r;
  MeshHandle result = changed(progress, setter.threads(),
                              [&](const Monitor& monitor) { return smooth(*mesh.mesh, options, &r, monitor); });
  return {std::move(result), toPython({{"vertices", r.vertices},
                                       {"triangles", r.triangles},
                                       {"boundary_vertices", r.boundaryVertices},
                                       {"degenerate_faces", r.degenerateFaces},
                                       {"mean_edge", r.meanEdge},
                                       {"mean_sigma", r.meanSigma},
                                       {"largest_sigma", r.largestSigma},
                                       {"mean_move", r.meanMove},
                                       {"largest_move", r.largestMove},
                                       {"limited_moves", r.limitedMoves}})};
}

Changed subdivided(const MeshHandle& mesh, const py::dict& given, const py::object& progress) {
  const Setter setter(given);
  SubdivideOptions options;
  setter.set<int>("levels", options.levels);
  setter.setWord("scheme", kSchemes, options.scheme);
  setter.setWord("weights", kWeights, options.weights);
  const py::object covariance = setter.given("covariance");
  if (covariance.is_none()) {
    options.covariances.reset();
  } else {
    options.covariances->source = valueOf(kCovariances, "covariance", covariance.cast<std::string>());
    setter.set<double>("bias", options.covariances->bias);
    setter.set<double>("absolute_bias", options.covariances->absoluteBias);
    setter.set<double>("sigma_normal", options.covariances->sigmaNormal);
  }
  setter.set<double>("crease_angle", options.creaseAngle);
  setter.set<bool>("normals", options.normals);
  setter.set<bool>("curvature", options.curvature);
  setter.set<bool>("keep_covariances", options.keepCovariances);
  setter.set<bool>("limit", options.limit);
  options.limit = options.limit || options.normals || options.curvature;
  SubdivideReport r;
  MeshHandle result = changed(progress, setter.threads(),
                              [&](const Monitor& monitor) { return subdivide(*mesh.mesh, options, &r, monitor); });
  return {std::move(result), toPython({{"faces_before", r.facesBefore},
                                       {"faces", r.facesAfter},
                                       {"vertices_before", r.verticesBefore},
                                       {"vertices", r.verticesAfter},
                                       {"triangulated_faces", r.triangulatedFaces},
                                       {"unused_vertices", r.unusedVertices},
                                       {"boundary_edges", r.boundaryEdges},
                                       {"crease_edges", r.creaseEdges},
                                       {"extraordinary_vertices", r.extraordinaryVertices},
                                       {"estimated_curvatures", r.estimatedCurvatures}})};
}

}  // namespace

void addVerbs(py::module_& module) {
  module.def("decimate", &decimated);
  module.def("cluster", &clustered);
  module.def("smooth", &smoothed);
  module.def("subdivide", &subdivided);
}

}  // namespace pdc::python
