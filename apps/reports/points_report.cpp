#include "reports/points_report.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const TriangulateReport& report) {
  return {{"seeds", report.seeds},
          {"components", report.components},
          {"boundary_loops", report.boundaryLoops},
          {"refused_non_manifold", report.nonManifoldRefused},
          {"refused_overlapping", report.overlappingRefused},
          {"split_vertices", report.splitVertices},
          {"filled_loops", report.filledLoops},
          {"added_vertices", report.addedVertices},
          {"dropped_triangles", report.droppedTriangles},
          {"unused_gaussians", report.unusedGaussians}};
}

}  // namespace

nlohmann::ordered_json toJson(const MixtureReport& report) {
  auto levels = Json::array();
  for (const MixtureLevelReport& level : report.levels)
    levels.push_back({{"gaussians_before", level.before},
                      {"gaussians", level.after},
                      {"parents", level.parents},
                      {"kept", level.kept},
                      {"clamped", level.clamped},
                      {"log_likelihood", level.logLikelihood}});
  return {{"points", report.points}, {"duplicates", report.duplicates}, {"sigma0", report.sigma0}, {"levels", levels}};
}

nlohmann::ordered_json toJson(const ReconstructReport& report) {
  return {{"mixture", toJson(report.mixture)},
          {"gaussians", report.gaussians},
          {"triangulation", toJson(report.triangulation)},
          {"control_triangles", report.controlTriangles},
          {"dropped_parts", report.droppedParts}};
}

}  // namespace pdc
