#include <utility>

#include "convert.h"
#include "given_options.h"
#include "groups/groups.h"
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

/// Runs change(monitor) on so many threads.
template <typename Change>
MeshHandle changed(const py::object& progress, int threads, const Change& change) {
  return MeshHandle(makePolitely(progress, threads, change));
}

Changed decimated(const MeshHandle& mesh, const py::dict& given, const py::object& progress) {
  const GivenOptions asked(given);
  DecimateOptions options;
  asked.take("faces", options.faces);
  asked.take("ratio", options.ratio);
  asked.take("error", options.error);
  asked.take("weld", options.weld);
  asked.takeWord("quadric", kQuadrics, options.quadric);
  asked.takeWord("placement", kPlacements, options.placement);
  asked.take("sigma_normal", options.sigmaNormal);
  asked.take("sigma_position", options.sigmaPosition);
  asked.take("sigma_property", options.sigmaProperty);
  asked.take("memory", options.memory);
  asked.take("max_turn", options.maxTurn);
  asked.take("boundary_weight", options.boundaryWeight);
  asked.take("lock_boundary", options.lockBoundary);
  asked.take("sound", options.sound);
  asked.take("fit", options.fit);
  asked.take("pair_distance", options.pairDistance);
  DecimateReport r;
  MeshHandle result = changed(progress, asked.threads(),
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
  const GivenOptions asked(given);
  ClusterOptions options;
  asked.take("cell", options.cell);
  asked.takeWord("quadric", kQuadrics, options.quadric);
  asked.take("sigma_normal", options.sigmaNormal);
  asked.take("sigma_position", options.sigmaPosition);
  asked.take("weld", options.weld);
  asked.take("free", options.free);
  asked.take("clean", options.clean);
  ClusterReport r;
  MeshHandle result = changed(progress, asked.threads(),
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
  const GivenOptions asked(given);
  SmoothOptions options;
  asked.take("iterations", options.iterations);
  asked.take("sigma", options.sigma);
  asked.take("sigma_property", options.sigmaProperty);
  asked.take("normalise_area", options.normaliseArea);
  asked.take("plain", options.plain);
  asked.take("lock_boundary", options.lockBoundary);
  SmoothReport r;
  MeshHandle result = changed(progress, asked.threads(),
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
  const GivenOptions asked(given);
  SubdivideOptions options;
  asked.take("levels", options.levels);
  asked.takeWord("scheme", kSchemes, options.scheme);
  asked.takeWord("weights", kWeights, options.weights);
  const py::object covariance = asked.given("covariance");
  if (covariance.is_none()) {
    options.covariances.reset();
  } else {
    options.covariances->source = valueOf(kCovariances, "covariance", covariance.cast<std::string>());
    asked.take("bias", options.covariances->bias);
    asked.take("absolute_bias", options.covariances->absoluteBias);
    asked.take("sigma_normal", options.covariances->sigmaNormal);
  }
  asked.take("crease_angle", options.creaseAngle);
  asked.take("normals", options.normals);
  asked.take("curvature", options.curvature);
  asked.take("keep_covariances", options.keepCovariances);
  asked.take("limit", options.limit);
  options.limit = options.limit || options.normals || options.curvature;
  SubdivideReport r;
  MeshHandle result = changed(progress, asked.threads(),
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
