#include "commands/check_command.h"

#include <fmt/format.h>

#include <string>

#include "files/json_file.h"
#include "files/mesh_file.h"
#include "parallel/with_threads.h"
#include "reports/check_facts.h"
#include "terminal/busy_sign.h"
#include "terminal/facts_text.h"
#include "terminal/interrupt.h"
#include "terminal/numbers.h"
#include "terminal/progress_bar.h"
#include "terminal/shown_path.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

Json factsOf(const CheckRequest& request) {
  const MeshFile file = [&] {
    const ExitOnInterrupt scope;
    const BusySign sign(!request.quiet, "reading " + request.file.filename().string());
    return readMeshFile(request.file, request.quiet);
  }();
  ProgressBar bar(!request.quiet);
  const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
  Json facts{{"file", shownPath(request.file)}};
  facts.update(checkFacts(file, {.progress = show, .stop = &interruptFlag()}));
  return facts;
}

std::string verdict(const Json& facts) {
  if (facts["clean"]) return "clean";
  std::string text;
  for (const Json& fault : facts["faults"]) {
    const auto name = fault.get<std::string>();
    const bool counts = !facts[name].is_boolean();
    const bool more = name == "self_intersections" && !facts["all_self_intersections_counted"];
    text += fmt::format("{}{}{}{}{}", text.empty() ? "not clean: " : ", ", more ? "more than " : "",
                        counts ? facts[name].dump() : "", counts ? " " : "", factLabel(name));
  }
  return text;
}

}  // namespace

void addCheckOptions(CLI::App& command, CheckRequest& request) {
  command.add_option("MESH", request.file, ".ply, .obj, .off or .stl")->required()->type_name("");
  command.add_flag("--allow-boundary", request.allowBoundary, "Edges with one face are no fault");
  command.add_flag("--allow-empty", request.allowEmpty, "A mesh without faces is no fault");
  command.add_option("--json", request.json, "The same for programs; - is standard output")->type_name("FILE");
  command.add_flag("--quiet", request.quiet, "No text and no progress bar");
  addThreads(command, request.threads);
  command.footer(
      "Exit code 0 if the mesh is clean: the oriented boundary of a solid, with faces, without boundary edges, "
      "non-manifold\n"
      "edges and vertices, misoriented edges, duplicate, degenerate and zero-area faces, non-finite vertices and "
      "triangles\n"
      "that intersect, and not inside out. Unused vertices are no fault. 1 if it is not, or cannot be read.\n"
      "Example: pdc check part.ply");
}

bool runCheck(const CheckRequest& request) {
  checkJsonPath(request.json);
  Json facts = detail::withThreads(request.threads.value_or(0), [&] { return factsOf(request); });
  facts["faults"] = faultsIn(facts, {.boundary = request.allowBoundary, .empty = request.allowEmpty});
  facts["clean"] = facts["faults"].empty();

  writeJson(facts, request.json);
  if (request.json.empty() && !request.quiet) {
    Json shown = facts;
    for (const char* name : {"faults", "clean", "warnings"}) shown.erase(name);
    printFacts(shown);
    fmt::print("{}\n", verdict(facts));
  }
  return facts["clean"].get<bool>();
}

}  // namespace pdc
