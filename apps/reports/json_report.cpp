#include "reports/json_report.h"

#include <cmath>
#include <thread>

#include "parallel/machine_memory.h"
#include "terminal/shown_path.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const std::optional<GridMeaning>& meaning) {
  if (!meaning) return {};
  return {{"class", nameOf(meaning->gridClass)},
          {"class_decided_by", nameOf(meaning->classBy)},
          {"inside", nameOf(meaning->inside)},
          {"inside_decided_by", nameOf(meaning->insideBy)},
          {"slope", meaning->slope},
          {"half_width_voxels", meaning->halfWidth}};
}

Json volumeJson(const std::optional<InputVolume>& volume) {
  if (!volume) return nullptr;
  return {{"format", volume->format}, {"encoding", volume->encoding}, {"size", volume->size},
          {"space", volume->space},   {"unit", volume->unit},         {"orientation", volume->orientation}};
}

Json toJson(const std::optional<InputMeshFacts>& mesh) {
  if (!mesh) return {};
  return {{"triangles", mesh->triangles}, {"open_edges", mesh->openEdges}, {"voxel_size", mesh->voxelSize}};
}

Json adaptiveJson(const MeshRequest& request, const MeshRun& run) {
  if (!run.options.adaptive) return nullptr;
  return {{"distance", *run.options.adaptive},
          {"grid", request.adaptiveGrid ? Json(*request.adaptiveGrid) : Json()},
          {"triangles_before", run.contour.trianglesBefore},
          {"largest_vertex_distance", run.contour.adaptedDistance}};
}

}  // namespace

nlohmann::ordered_json sigmaNormalJson(const std::optional<double>& sigma) {
  if (!sigma) return "auto";
  return std::isinf(*sigma) ? Json("inf") : Json(*sigma);
}

nlohmann::ordered_json toJson(const std::vector<GridStepReport>& steps) {
  Json list = Json::array();
  for (const GridStepReport& step : steps) {
    list.push_back({{"name", step.name},
                    {"parameter", step.parameter},
                    {"voxels_before", step.voxelsBefore},
                    {"voxels_after", step.voxelsAfter}});
    if (step.name != "keep" && step.name != "fill-cavities") continue;
    list.back()["parts_before"] = step.partsBefore;
    list.back()["parts_after"] = step.partsAfter;
  }
  return list;
}

nlohmann::ordered_json toJson(const MeshRequest& request, const MeshRun& run) {
  const unsigned allThreads = std::thread::hardware_concurrency();
  const unsigned threads = run.options.threads > 0 ? static_cast<unsigned>(run.options.threads) : allThreads;
  return {{"input", shownPath(request.input)},
          {"output", shownPath(request.output)},
          {"vertices", run.vertices},
          {"quads", run.quads},
          {"triangles", run.triangles},
          {"boundary_edges", run.contour.boundaryEdges},
          {"slabs", run.slabs},
          {"blocks", run.contour.blocks},
          {"crossings", run.contour.crossings},
          {"crossings_without_normal", run.contour.crossingsWithoutNormal},
          {"vertices_on_box", run.verticesOnBox},
          {"crossings_without_data", run.crossingsWithoutData},
          {"clamped_vertices", run.contour.clamped},
          {"out_of_cell_vertices", run.contour.outOfCell},
          {"multi_vertex_cells", run.contour.multiVertexCells},
          {"shortened_vertices", run.contour.shortened},
          {"drawn_in_vertices", run.contour.drawnIn},
          {"forced_diagonals", run.contour.forcedDiagonals},
          {"fans", run.contour.fans},
          {"uncertified_pairs", run.contour.uncertified},
          {"iso", run.iso},
          {"grid", toJson(run.meaning)},
          {"volume", volumeJson(run.volume)},
          {"mesh", toJson(run.mesh)},
          {"properties", run.properties},
          {"steps", toJson(run.steps)},
          {"adaptive", adaptiveJson(request, run)},
          {"sigma_n", sigmaNormalJson(run.options.sigmaNormal)},
          {"median_sigma_n", run.contour.medianSigmaNormal},
          {"normal_noise", run.contour.normalNoise},
          {"crease_patches", run.contour.creasePatches},
          {"origin", {run.origin.x, run.origin.y, run.origin.z}},
          {"double_precision", request.doublePrecision},
          {"sigma_grid", request.sigmaGrid ? Json(*request.sigmaGrid) : Json()},
          {"weight_grid", request.weightGrid ? Json(*request.weightGrid) : Json()},
          {"placement", placementName(request.placement)},
          {"hermite", planeOriginName(run.planeOrigin)},
          {"value_noise_voxels", run.valueNoise},
          {"threads", threads},
          {"bytes_written", run.bytesWritten},
          {"peak_memory_bytes", detail::peakMemory()},
          {"warnings", run.warnings},
          {"seconds",
           {{"read", run.secondsRead},
            {"contour", run.secondsContour},
            {"write", run.secondsWrite},
            {"total", run.secondsTotal}}}};
}

}  // namespace pdc
