#include "commands/info_command.h"

#include "commands/info_facts.h"
#include "commands/json_report.h"
#include "terminal/busy_sign.h"
#include "terminal/facts_text.h"
#include "terminal/interrupt.h"

namespace pdc {
void addInfoOptions(CLI::App& command, InfoRequest& request) {
  command.add_option("FILE", request.file, ".vdb, a scene (.yaml, .yml), or a mesh: .ply, .obj, .off, .stl")
      ->required()
      ->type_name("");
  command.add_option("--json", request.json, "The same for programs; - is standard output")->type_name("FILE");
  command.add_flag("--quiet", request.quiet, "No word on standard error while a large file is read");
}

void runInfo(const InfoRequest& request) {
  checkJsonPath(request.json);
  const ExitOnInterrupt scope;
  nlohmann::ordered_json facts = [&] {
    const BusySign sign(!request.quiet, "reading " + request.file.filename().string());
    return gatherFacts(request.file);
  }();
  if (request.json.empty()) {
    facts.erase("warnings");  // They are on standard error already.
    printFacts(facts);
  } else {
    writeJson(facts, request.json);
  }
}

}  // namespace pdc
