#include "commands/info_command.h"

#include "commands/info_comparison.h"
#include "files/json_file.h"
#include "reports/info_facts.h"
#include "terminal/busy_sign.h"
#include "terminal/facts_text.h"
#include "terminal/interrupt.h"

namespace pdc {
void addInfoOptions(CLI::App& command, InfoRequest& request) {
  command.add_option("FILE", request.file, ".vdb, a scene (.yaml, .yml), or a mesh: .ply, .obj, .off, .stl")
      ->required()
      ->type_name("");
  CLI::Option* reference = command.add_option("--reference", request.reference,
                                              "Mesh to compare with: distances and angles between the two");
  reference->type_name("MESH");
  command.add_option("--samples", request.samples, "Points on each of the two surfaces (1000000)")
      ->type_name("N")
      ->needs(reference);
  command.add_option("--json", request.json, "The same for programs; - is standard output")->type_name("FILE");
  command.add_flag("--quiet", request.quiet, "No word on standard error while a large file is read, no progress bar");
}

void runInfo(const InfoRequest& request) {
  checkJsonPath(request.json);
  nlohmann::ordered_json facts;
  if (request.reference.empty()) {
    const ExitOnInterrupt scope;
    const BusySign sign(!request.quiet, "reading " + request.file.filename().string());
    facts = gatherFacts(request.file);
  } else {
    facts = compareFiles(request);
  }
  const ExitOnInterrupt scope;
  if (request.json.empty()) {
    facts.erase("warnings");  // They are on standard error already.
    printFacts(facts);
  } else {
    writeJson(facts, request.json);
  }
}

}  // namespace pdc
