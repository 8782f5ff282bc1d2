#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "commands/slabs/slab_commands.h"
#include "extract/contour_memory.h"
#include "files/json_file.h"
#include "files/mesh_attributes.h"
#include "parallel/stopwatch.h"
#include "parallel/with_threads.h"
#include "pdc/tile/slab_folder.h"
#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"
#include "terminal/shown_path.h"
#include "terminal/warning.h"
#include "tiles/contour_in_slabs.h"
#include "tiles/planned_request.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const PlanRequest& request, const SlabPlan& plan, const std::vector<std::string>& warnings,
            double seconds) {
  Json slabs = Json::array();
  for (const Slab& s : plan.slabs) slabs.push_back({{"begin", s.begin}, {"end", s.end}, {"vertices", s.vertices}});
  return {{"input", shownPath(request.mesh.input)},
          {"folder", request.folder.string()},
          {"slabs", slabs},
          {"origin", {plan.origin.x, plan.origin.y, plan.origin.z}},
          {"warnings", warnings},
          {"seconds", seconds}};
}

/// Options are all of the command but its own.
std::vector<std::string> ofMesh(std::vector<std::string> arguments) {
  std::erase_if(arguments, [](const std::string& a) { return a.starts_with("--slabs="); });
  return arguments;
}

std::uint64_t verticesOf(const SlabPlan& plan) {
  std::uint64_t sum = 0;
  for (const Slab& s : plan.slabs) sum += s.vertices;
  return sum;
}

}  // namespace

void runPlan(const PlanRequest& request, const std::vector<std::string>& arguments) {
  MeshRequest mesh = request.mesh;
  mesh.output = "slabs.ply";
  checkMeshRequest(mesh);
  checkJsonPath(mesh.json);
  if (mesh.adaptive) throw Error("--adaptive needs the whole mesh, which cannot be made slab by slab");
  detail::Stopwatch stopwatch;
  ProgressBar bar(!mesh.quiet);
  const Monitor monitor{.progress = [&bar](const char* stage, double share) { bar.update(stage, share); },
                        .stop = &interruptFlag()};
  const Input input = detail::withThreads(mesh.threads.value_or(0),
                                          [&] { return openInput(mesh.input, mesh.inputOptions(), monitor); });
  for (const std::string& warning : input.warnings) printWarning(warning);
  checkAttributes(input, mesh.ownProperties());
  const SlabPlan plan = planSlabs(*input.source, mesh.contourOptions(input.sigmaNormal),
                                  {.slabs = request.slabs.value_or(0), .maxMemory = mesh.maxMemory}, monitor);
  const PlannedRequest planned{
      .mesh = mesh, .space = input.volume ? input.volume->space : "", .unit = input.volume ? input.volume->unit : ""};
  SlabFolder::create(request.folder, plan, plannedText(mesh.input, ofMesh(arguments), planned));
  writeJson(toJson(request, plan, input.warnings, stopwatch.lap()), mesh.json);
  if (!mesh.quiet && mesh.json != "-")
    fmt::print("{}: {} slabs, {} vertices\n", request.folder.string(), plan.slabs.size(),
               detail::countText(static_cast<double>(verticesOf(plan))));
}

}  // namespace pdc
