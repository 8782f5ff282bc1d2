#include "reports/check_facts.h"

#include <array>
#include <cstddef>

#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "reports/info_facts.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto kBoundary = "boundary_edges", kNoFaces = "no_faces";
/// Facts that are 0 or false for a clean mesh.
constexpr std::array kFaults = {
    kNoFaces,          kBoundary,          "non_manifold_edges",  "non_manifold_vertices", "misoriented_edges",
    "duplicate_faces", "degenerate_faces", "zero_area_triangles", "non_finite_vertices",   "self_intersections",
    "inside_out"};

}  // namespace

Json checkFacts(const MeshFile& file, const Monitor& monitor) {
  const MeshReport report = analyze(file.mesh, {.progress = {}, .stop = monitor.stop});
  const SelfIntersections found = selfIntersections(file.mesh, {}, monitor);
  Json facts = meshFacts(file, report);
  facts[kNoFaces] = file.mesh.empty();
  facts["inside_out"] = report.boundaryEdges == 0 && report.volume < 0;
  facts["zero_area_triangles"] = found.degenerateTriangles;
  facts["self_intersections"] = found.pairs.size();
  facts["all_self_intersections_counted"] = found.complete;
  return facts;
}

Json faultsIn(const Json& facts, const CheckAllowances& allowed) {
  Json faults = Json::array();
  for (const char* name : kFaults) {
    if ((name == kBoundary && allowed.boundary) || (name == kNoFaces && allowed.empty)) continue;
    const Json& fact = facts[name];
    if (fact.is_boolean() ? fact.get<bool>() : fact.get<std::size_t>() > 0) faults.push_back(name);
  }
  return faults;
}

}  // namespace pdc
